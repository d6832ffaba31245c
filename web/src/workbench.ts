/** The program's text, the machine that runs it, and the tape that comes of it: what belongs together between them. */
import type { Punched } from "./board.ts";
import { labelOf } from "./catalogue.ts";
import { get } from "./dom.ts";
import { Editor } from "./editor.ts";
import { saveFile } from "./files.ts";
import { nameFor, type Origin, originOf } from "./identity.ts";
import { isWord, t, type Word } from "./language.ts";
import { hide, say, show } from "./message.ts";
import { parametersOf, showParameters, withValue } from "./parameters.ts";
import { Proof } from "./proof.ts";
import type { Maker } from "./recording.ts";
import type { Session } from "./session.ts";
import { withSigns } from "./signs.ts";
import { Stage } from "./stage.ts";
import type { Works } from "./works.ts";

/** The editor's text is tried, and run where that is wanted, so long after the last key, ms. */
const MOMENT = 500;
/** The same for a slider. */
const SHORT = 80;

export interface Surroundings {
  readonly works: Works;
  /** The name of the part whose program this is, letter for letter. */
  partOf(program: string): string | undefined;
  /** A change runs by itself. */
  isAuto(): boolean;
  /** The machine lists a text that was sent to it. */
  listed(text: string, program: string): void;
  /** The manual, at a chapter. */
  openManual(chapter: number): void;
  /** The drawing is to be seen. */
  showDrawing(): void;
}

export class Workbench {
  readonly stage = new Stage();
  readonly editor: Editor;
  readonly #around: Surroundings;
  readonly #proof: Proof;
  session!: Session;
  /** The file that was opened, until another program takes its place. */
  origin: Origin | undefined;
  /** The text that the address leads to: while it is seen, the link stays in the address bar. */
  linked: string | undefined;
  #sent: string | undefined;
  #wait: ReturnType<typeof setTimeout> | undefined;
  /** The visitor has pressed RUN: who is asked for a number types it at the teletype. */
  isByHand = false;

  constructor(around: Surroundings) {
    this.#around = around;
    this.editor = new Editor(get("lines"), this.stage.chooser, () => this.stage.recording.layout, {
      changed: () => this.#edited(),
      run: () => void this.run(),
    });
    this.#proof = new Proof(this.editor, around.openManual);
  }

  get isDirty(): boolean {
    return this.editor.text !== this.session.program;
  }

  /** The name of what is seen, for its files. */
  get name(): string {
    return this.#nameOf(this.editor.text).name;
  }

  /** The name of the part that is seen, letter for letter. */
  get part(): string | undefined {
    return this.#around.partOf(this.editor.text);
  }

  #nameOf(program: string): { name: string; isPart: boolean } {
    return nameFor(program, this.#around.partOf(program), this.origin);
  }

  /** A run's error and its line, until the machine tells the program that has this line. */
  #fault: [string, number] | undefined;

  #maker = (): Maker => {
    const program = this.#sent ?? this.session.program;
    return { ...this.#nameOf(program), program };
  };

  punched(punched: readonly Punched[]): void {
    this.stage.pictures.isStale = this.isStale;
    this.stage.punched(punched, this.#maker, () => {
      this.stage.pictures.isStale = this.isStale;
      this.editor.marks = [];
    });
    const program = this.stage.recording.takeProgram();
    const take = (): void => saveFile(`${this.name}.skg`, program ?? "");
    if (program) show(t("punchedProgram"), { label: t("saveSkg"), take });
  }

  /** The drawing was made by another program than the one in the editor. */
  get isStale(): boolean {
    return this.stage.isOther(this.editor.text);
  }

  /** The machine tells its program: the editor shows it, unless it holds a text that the machine has not. */
  memory(program: string, before: string): void {
    // (in the middle of a long LOAD it has a part of it alone)
    if (this.#sent !== undefined && !hasLinesOf(program, this.#sent) && this.session.isRunning) return;
    this.stage.tell({ ...this.#nameOf(program), program });
    const isSent = this.#sent === this.editor.text;
    if (this.#sent !== undefined && isSent) this.#around.listed(this.#sent, program);
    if (isSent && this.linked === this.#sent) this.linked = program;
    if (isSent ? hasLinesOf(program, this.editor.text) : before === this.editor.text) this.editor.text = program;
    this.#sent = undefined;
    if (this.#fault && !this.isDirty) this.#proof.ended(...this.#fault);
    this.#fault = undefined;
    this.#around.works.keep(program);
    if (!program) this.origin = undefined; // (NEW at the teletype)
    this.refresh();
  }

  refresh(): void {
    this.session.draft = this.isDirty ? this.editor.text : undefined;
    if (this.linked !== undefined && this.editor.text !== this.linked) {
      // (what is changed from here on is the visitor's: a reload does not bring the link's program again)
      this.linked = undefined;
      history.replaceState(null, "", location.pathname + location.search);
    }
    const link = this.linked === undefined ? undefined : location.hash;
    this.session.about = { work: this.#around.works.present, origin: this.origin, link };
    get("revert").hidden = !this.isDirty;
    const parameters = parametersOf(this.editor.text).map((each) => ({ ...each, label: labelOf(each.label) }));
    showParameters(get("parameters"), parameters, (at, value) => this.#set(at, value));
    get("no-program").hidden = this.editor.text !== "";
    document.body.classList.toggle("talks", /^\s*\d+\s*(PRINT|INPUT)/im.test(this.editor.text));
    this.stage.pictures.isStale = this.isStale;
    this.stage.pictures.say();
  }

  /** A parameter has another value: the part is cut anew after a moment. */
  #set(at: number, value: string): void {
    const parameter = parametersOf(this.editor.text)[at];
    if (!parameter) return;
    this.editor.text = withValue(this.editor.text, parameter, value);
    this.refresh();
    clearTimeout(this.#wait);
    this.#wait = setTimeout(() => void this.#tryText(true), SHORT);
  }

  #edited(): void {
    this.refresh();
    clearTimeout(this.#wait);
    this.#wait = setTimeout(() => void this.#tryText(), MOMENT);
  }

  async #tryText(isAuto = this.#around.isAuto()): Promise<void> {
    if (this.editor.isComposing) {
      this.#wait = setTimeout(() => void this.#tryText(isAuto), MOMENT);
      return;
    }
    this.#keep();
    const isSound = await this.#proof.check(this.session);
    if (isSound && this.isDirty && isAuto && this.editor.text) this.#send(true);
  }

  /** The text as it is now stays, whatever comes. */
  #keep(): void {
    this.editor.narrow();
    this.refresh();
    this.session.keep();
  }

  /** RUN: a text that was changed goes into the machine first, when all of it can. */
  async run(): Promise<void> {
    if (!this.session.isAlive || this.session.isRunning) return;
    clearTimeout(this.#wait);
    this.isByHand = true;
    hide();
    this.#keep();
    if (!this.isDirty) {
      this.session.run();
    } else if (await this.#proof.check(this.session)) {
      this.#send(true);
    } else {
      say("notTaken");
      return;
    }
    this.#around.showDrawing();
  }

  #send(run: boolean): void {
    this.#sent = this.editor.text;
    this.#fault = undefined;
    this.stage.recording.leave(this.session.isRunning);
    this.session.load(this.#sent, run);
  }

  /** Puts another program in the place of what is there, which is kept; one with faults stays a text. `file`: its file's name. */
  async open(text: string, { run = false, isSound = false, file = "", isLinked = false } = {}): Promise<void> {
    clearTimeout(this.#wait);
    const { works } = this.#around;
    this.keepText();
    works.begin();
    hide();
    this.isByHand = run;
    this.editor.text = withSigns(text);
    this.origin = file ? originOf(file, this.editor.text) : undefined;
    this.editor.marks = [];
    this.editor.tip = undefined;
    if (isLinked) this.linked = this.editor.text;
    this.stage.clear(this.#maker(), this.session.isRunning);
    if (!this.session.isAlive) {
      this.refresh();
      return;
    }
    if (!isSound && !(await this.#proof.check(this.session, true))) {
      this.refresh();
      say("notTaken");
      return;
    }
    this.#send(run);
    if (run) this.#around.showDrawing();
    this.refresh();
  }

  /** Keeps what is seen among the visitor's programs. */
  keepText(): void {
    this.#around.works.keep(this.isDirty ? this.editor.text : this.session.program);
  }

  /** The machine's program again, in place of what was typed; undo brings that back. */
  revert(): void {
    this.editor.text = this.session.program;
    this.editor.marks = [];
    this.refresh();
    this.editor.focus();
  }

  error(number: string, line: number): void {
    const word = `err${number}`;
    if (!isWord(word)) return;
    const isMarked = !line || (!this.isDirty && this.#proof.ended(number, line));
    this.#fault = isMarked ? undefined : [number, line];
    show(t(line ? "endedLine" : "ended", number, t(word as Word), line || ""));
  }
}

/** The machine's program has all the lines of a text. */
function hasLinesOf(program: string, text: string): boolean {
  const numbers = (lines: string): string[] =>
    [...lines.matchAll(/^\s*(\d+)[ \t]*[^\s\d]/gm)].map(([, number]) => String(Number(number)));
  const there = new Set(numbers(program));
  return numbers(text).every((number) => there.has(number));
}
