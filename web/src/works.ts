/** The visitor's own programs: each is kept, named by its first REM and dated, until it is deleted. */
import { get, make } from "./dom.ts";
import { spoken, t } from "./language.ts";
import { show } from "./message.ts";

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

/** A program's title: the words of its first REM; empty without one. */
export const titleOf = (program: string): string => (/^\s*\d+\s*REM[ \t]*(\S.*)$/im.exec(program)?.[1] ?? "").trim().slice(0, 60);

/** A program's name in a list: its title, else its first line. */
export const nameOf = (program: string): string =>
  titleOf(program) || (program.split("\n").find((line) => line.trim()) ?? "").trim().slice(0, 60);

/** A change of the same program keeps half of its lines; what keeps fewer is another program. */
function isChangeOf(before: string, after: string): boolean {
  const lines = before.split("\n").filter(Boolean);
  const left = new Set(after.split("\n"));
  return lines.filter((line) => left.has(line)).length * 2 >= lines.length;
}

/** Another title is another program; a title that comes to one without is its own. */
const hasTitleOf = (before: string, after: string): boolean => {
  const [old, title] = [titleOf(before), titleOf(after)];
  return !old || old === title;
};

export class Works {
  readonly #shelf: Shelf;
  readonly #isKnown: (program: string) => boolean;
  readonly #changed: () => void;
  /** The work that is being written, as it was kept last. */
  #id: string | undefined;
  #last = "";

  /** `isKnown`: tells an example, which anybody has, from the visitor's own programs. */
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

  /** The work that is being written, for the next visit. */
  get present(): string | undefined {
    return this.#id;
  }

  /** Goes on with the work of the last visit. Without one the program in the machine was deleted, or opened and not changed: it does
   * not come back by itself. */
  goOn(id: string | undefined, program: string): void {
    const work = this.#shelf.works.find((each) => each.id === id);
    this.#id = work?.id;
    this.#last = work?.program ?? (id === undefined ? program : "");
  }

  /** Begins another work: what is kept next gets an entry of its own, also when it is a change of one that was opened. */
  begin(): void {
    this.#id = undefined;
    this.#last = "";
  }

  /** Keeps a program: in its own entry while it is changed little by little, else in a new one. */
  keep(program: string): void {
    if (!this.isOwn(program)) {
      this.begin();
      return;
    }
    if (program === this.#last) return;
    const works = this.#shelf.works;
    const there = works.find((work) => work.program === program);
    const isNext = !there && isChangeOf(this.#last, program) && hasTitleOf(this.#last, program);
    const id = there?.id ?? (isNext ? this.#id : undefined) ?? newId();
    const work: Work = { id, name: nameOf(program), when: Date.now(), program };
    this.#shelf.works = [work, ...works.filter((each) => each.id !== id)];
    // (what was there already stays as it is when the next change comes)
    this.#id = there ? undefined : id;
    this.#last = program;
    this.#changed();
  }

  /** Adds works of a file; one that is there already is not added twice. */
  add(works: readonly Work[]): void {
    const there = this.#shelf.works;
    const added = works.filter(({ program }) => !there.some((work) => work.program === program));
    if (!added.length) return;
    const ids = new Set(there.map(({ id }) => id));
    this.#shelf.works = [...there, ...added.map((work) => (ids.has(work.id) ? { ...work, id: newId() } : work))];
    this.#changed();
  }

  /** Takes a work away; the function that is returned brings it back. */
  delete(id: string): () => void {
    const work = this.#shelf.works.find((each) => each.id === id);
    // (while it is still in the machine it does not come back by itself)
    if (work && this.#id === id) {
      this.begin();
      this.#last = work.program;
    }
    this.#shelf.works = this.#shelf.works.filter((each) => each.id !== id);
    this.#changed();
    return () => work && this.add([work]);
  }
}

const newId = (): string => crypto.getRandomValues(new Uint32Array(2)).join("-");

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
      bin.addEventListener("click", () => {
        const undo = works.delete(work.id);
        show(t("deleted", work.name), { label: t("undo"), take: undo });
        get("shelf").focus();
      });
      row.append(button, bin);
      return row;
    }),
  );
}
