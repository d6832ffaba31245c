/** The lessons beside the program: their words, their tasks, and whether the tape is right. */
import { get, make, onClick, tell } from "./dom.ts";
import { t } from "./language.ts";
import { differenceOf, LessonError, type Lessons, readLessons, type Step } from "./lessons.ts";
import { LinkError, MOST, pack } from "./link.ts";
import { say, show } from "./message.ts";
import { insideText } from "./pieces.ts";
import { isSmall, view } from "./shell.ts";
import type { Workbench } from "./workbench.ts";

/** The step under way is remembered while the tab is there: a reload leaves the learner's text alone. */
const HERE = "skg:lesson";

export class Course {
  readonly #bench: Workbench;
  #lessons: Lessons | undefined;
  #at = 0;
  /** The file that a teacher wrote, packed for the address; empty: the page's own steps. */
  #code = "";
  /** All programs of the steps that were opened, and as the machine lists them, with their texts: a teacher may write small letters,
   * blanks, 5.0. They stay when the lessons are closed, or others opened. */
  readonly #given = new Map<string, string>();

  constructor(bench: Workbench) {
    this.#bench = bench;
    onClick("lesson-begin", () => void this.begin(1));
    onClick("lesson-before", () => this.#go(this.#at - 1));
    onClick("lesson-next", () => this.#go(this.#at + 1));
    onClick("lesson-again", () => this.#start());
    onClick("lesson-answer", () => {
      const { answer } = this.#step ?? {};
      if (answer) void this.#bench.open(answer, { run: true });
    });
    onClick("lesson-close", () => this.close());
  }

  get #step(): Step | undefined {
    return this.#lessons?.steps[this.#at];
  }

  /** A program that the lessons give: none of the learner's. */
  isGiven(program: string): boolean {
    return this.#given.has(program);
  }

  /** The machine lists a text that was sent to it. */
  listed(text: string, program: string): void {
    if (this.#given.has(text)) this.#given.set(program, text);
  }

  #take(lessons: Lessons): void {
    this.#lessons = lessons;
    for (const { program, answer } of lessons.steps) for (const text of [program, answer]) this.#given.set(text, text);
  }

  /** Opens the page's own steps, at one of them from 1. */
  async begin(number: number): Promise<void> {
    this.#code = "";
    this.#take(readLessons(await this.#read()));
    this.#go(number - 1);
  }

  /** Opens a teacher's file. */
  async open(name: string, text: string, number = 1): Promise<void> {
    try {
      const found = readLessons(text);
      // (its link holds the file)
      this.#code = await pack(text);
      this.#take(found);
    } catch (error) {
      if (error instanceof LessonError) say(error.why, name, error.line);
      else if (error instanceof LinkError) say("badLarge", name, MOST / 1024);
      else throw error;
      return;
    }
    this.#go(number - 1);
  }

  close(): void {
    if (get("lesson").hidden) return;
    this.#lessons = undefined;
    get("lesson").hidden = true;
    sessionStorage.removeItem(HERE);
    history.replaceState(null, "", location.pathname + location.search);
  }

  /** The page speaks another language. */
  async retell(): Promise<void> {
    if (!this.#lessons) return;
    if (!this.#code) this.#take(readLessons(await this.#read()));
    this.#show();
  }

  /** The machine is at its prompt: is the tape the one that is wanted? */
  check(): void {
    const step = this.#step;
    if (!step) return;
    const { recording } = this.#bench.stage;
    const answer = (text: string, isRight = false): void => {
      const box = get("lesson-check");
      tell(box, text);
      box.classList.toggle("right", isRight);
      // (on a small screen the drawing is seen now)
      if (text && isSmall()) show(text);
    };
    const { program } = recording.made;
    const isStart = program === undefined || this.#given.get(program) === step.program;
    if (recording.isEmpty || isStart) answer("");
    else if (!recording.isWhole || recording.how !== "run" || this.#bench.isStale) answer(t("lessonRun"));
    else if (!step.tape) {
      const gap = this.#bench.stage.pictures.gap;
      answer(t(gap ? "lessonOpen" : "lessonOwn"), !gap);
    } else {
      const difference = differenceOf(recording.layout, step.tape);
      if (!difference) answer(t("lessonRight"), true);
      else if ("block" in difference) {
        answer(t("lessonBlock", difference.block));
        this.#bench.stage.chooser.choose({ block: difference.block });
      } else {
        const [x, y] = difference.missing.map((each) => (each / 1000).toFixed(1));
        answer(t("lessonMissing", x ?? "", y ?? ""));
      }
    }
  }

  async #read(): Promise<string> {
    const file = t("lessonFile");
    return insideText(file) ?? (await (await fetch(file)).text());
  }

  #go(at: number): void {
    const steps = this.#lessons?.steps ?? [];
    this.#at = Math.max(0, Math.min(steps.length - 1, at));
    const hash = `#${this.#code ? `lessons=${this.#code}&` : ""}lesson=${this.#at + 1}`;
    history.replaceState(null, "", hash);
    this.#show();
    view("program");
    // (after a reload the learner's own text is there)
    if (sessionStorage.getItem(HERE) !== hash) this.#start();
    else this.check();
    sessionStorage.setItem(HERE, hash);
  }

  #start(): void {
    const { program = "" } = this.#step ?? {};
    get("lesson-check").textContent = "";
    void this.#bench.open(program, { run: true }).then(() => view("program"));
  }

  #show(): void {
    const [lessons, step] = [this.#lessons, this.#step];
    if (!lessons || !step) return;
    get("welcome").hidden = true;
    get("lesson").hidden = false;
    get("lesson-title").textContent = `${this.#at + 1}/${lessons.steps.length} ${step.title}`;
    const paragraphs = this.#at ? step.paragraphs : [...lessons.paragraphs, ...step.paragraphs];
    get("lesson-text").replaceChildren(
      ...paragraphs.map((paragraph) => {
        const box = make("p", "");
        box.append(...paragraph.split("`").map((part, at) => (at % 2 ? make("code", "", part) : part)));
        return box;
      }),
    );
    get<HTMLButtonElement>("lesson-before").disabled = !this.#at;
    get<HTMLButtonElement>("lesson-next").disabled = this.#at + 1 >= lessons.steps.length;
    get("lesson-answer").hidden = !step.answer;
    this.check();
  }
}
