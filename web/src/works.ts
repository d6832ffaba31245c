/** The visitor's own programs: each is kept, named by its first REM and dated, until it is deleted. */
import { get, make } from "./dom.ts";
import { spoken, t } from "./language.ts";

export interface Work {
  id: string;
  name: string;
  /** ms since 1970. */
  when: number;
  program: string;
}

/** The store of works; read again each time, since another tab may have written there. */
export interface Shelf {
  works: Work[];
}

/** A program's name: its first REM's words, else its first line. */
export function titleOf(program: string): string {
  const title = /^\s*\d+\s*REM[ \t]*(\S.*)$/im.exec(program)?.[1] ?? program.split("\n").find((line) => line.trim()) ?? "";
  return title.trim().slice(0, 60);
}

export const isSame = (a: string, b: string): boolean => a.replace(/\s/g, "") === b.replace(/\s/g, "");

/** The same but for digits that the machine's numbers have not: as it lists a program that was loaded. */
export const isAlike = (a: string, b: string): boolean => isSame(rounded(a), rounded(b));

const rounded = (program: string): string =>
  program.replace(/\d*\.\d+/g, (number) => String(Number(Number(number).toPrecision(8))));

/** A change of the same program keeps half of its lines; what keeps fewer is another program. */
function isChangeOf(before: string, after: string): boolean {
  const lines = before.split("\n").filter(Boolean);
  const left = new Set(after.split("\n"));
  return lines.filter((line) => left.has(line)).length * 2 >= lines.length;
}

export class Works {
  readonly #shelf: Shelf;
  readonly #isKnown: (program: string) => boolean;
  readonly #changed: () => void;
  #id: string | undefined;
  #last = "";

  /** `isKnown`: programs that anybody has, the examples, are none of the visitor's. */
  constructor(shelf: Shelf, isKnown: (program: string) => boolean, changed: () => void) {
    this.#shelf = shelf;
    this.#isKnown = isKnown;
    this.#changed = changed;
  }

  get all(): Work[] {
    return this.#shelf.works.filter(({ program }) => !this.#isKnown(program)).sort((a, b) => b.when - a.when);
  }

  /** Tells whether a program is the visitor's own. */
  isOwn(program: string): boolean {
    return program.trim() !== "" && !this.#isKnown(program);
  }

  /** Begins another program, however like the last one it is. */
  begin(): void {
    this.#id = undefined;
    this.#last = "";
  }

  /** Keeps a program: in its own place while it is changed little by little, else in a new one. */
  keep(program: string): void {
    if (!this.isOwn(program)) {
      this.begin();
      return;
    }
    if (program === this.#last) return;
    const works = this.#shelf.works;
    const there = works.find((work) => isSame(work.program, program));
    const isNext = this.#id !== undefined && isChangeOf(this.#last, program);
    const id = there?.id ?? (isNext ? this.#id : undefined) ?? crypto.getRandomValues(new Uint32Array(2)).join("-");
    const work: Work = { id, name: titleOf(program), when: Date.now(), program };
    this.#shelf.works = [work, ...works.filter((each) => each.id !== id)];
    this.#id = id;
    this.#last = program;
    this.#changed();
  }

  delete(id: string): void {
    const works = this.#shelf.works;
    // (while it is still in the machine it does not come back by itself)
    if (this.#id === id) {
      this.begin();
      this.#last = works.find((work) => work.id === id)?.program ?? "";
    }
    this.#shelf.works = works.filter((work) => work.id !== id);
    this.#changed();
  }
}

/** Fills the list of kept programs. */
export function showWorks(works: Works, open: (work: Work) => void): void {
  const date = new Intl.DateTimeFormat(spoken() === "zh" ? "zh-CN" : "en-GB", { dateStyle: "short", timeStyle: "short" });
  get("works").hidden = !works.all.length;
  get("work-list").replaceChildren(
    ...works.all.map((work) => {
      const row = make("li", "work");
      const button = make("button", "");
      button.type = "button";
      button.dataset["work"] = work.id;
      button.append(make("b", "", work.name), make("span", "", date.format(work.when)));
      button.addEventListener("click", () => open(work));
      const bin = make("button", "bin", "✕");
      bin.type = "button";
      bin.ariaLabel = bin.title = t("deleteWork", work.name);
      bin.addEventListener("click", () => works.delete(work.id));
      row.append(button, bin);
      return row;
    }),
  );
}
