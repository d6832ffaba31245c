/** The tape that is shown: its blocks and bytes, whether it has its end, and which program made it. */
import type { Punched, PunchedLine, PunchMark } from "./board.ts";
import { type Layout, Placer } from "./placed.ts";
import { type Item, readBlock } from "./tape.ts";
import { Written } from "./written.ts";

/** The maker of a tape: a program's name and text, or a file, whose program is unknown. */
export interface Maker {
  name: string;
  program: string | undefined;
  /** A part of the list, by that name. */
  isPart?: boolean;
}

/** The way in which a tape was made: by one RUN, by RUN n, by statements typed at the prompt, by a run and such statements
 * behind it. Only the first one is the program's tape. */
export type How = (typeof HOWS)[number];
const HOWS = ["run", "part", "typed", "mixed"] as const;
export const isHow = (word: unknown): word is How => HOWS.some((how) => how === word);

export interface KeptTape {
  made: Maker;
  lines: PunchedLine[];
  /** "run" where it is not told. */
  how?: How;
  from?: number;
}

/** A tape from a file: laid out, and as it is written. */
export interface Opened {
  items: readonly Item[];
  placer: Placer;
  written: Written;
  isWhole: boolean;
}

/** Lines of a tape that is kept for the next visit: some 300 KB. */
const MOST_KEPT = 5000;

export class Recording {
  #placer = new Placer();
  #items: Item[] = [];
  #written = new Written();
  #millimetres = 0;
  #isLeaving = false;
  #lines: PunchedLine[] = [];
  /** The board's work between two marks. */
  #work: "run" | "prompt" | "save" = "prompt";
  /** The reset button was pressed, or the page left, behind this tape: nothing is added to it. */
  #isOver = false;
  #program: string[] = [];
  /** It has its DD. A tape without it was broken off, is not punched to its end, or came so from a file. */
  isWhole = false;
  made: Maker = { name: "part", program: undefined };
  how: How = "run";
  /** The line at which RUN n began, for "part". */
  from = 0;
  /** The program of the run that began last is not known yet: the next memory tells it. */
  isFresh = false;

  get layout(): Layout {
    return this.#placer.layout;
  }

  get isEmpty(): boolean {
    return !this.#items.length;
  }

  /** The tape as it was punched, byte for byte. */
  get text(): string {
    return this.#written.text;
  }

  /** The place in the tape's text at which each block begins. */
  get offsets(): readonly number[] {
    return this.#written.offsets;
  }

  /** Its length on the drawing, mm. */
  get millimetres(): number {
    const { blocks } = this.layout;
    for (; this.#measured < blocks.length; this.#measured++) this.#millimetres += (blocks[this.#measured]?.length ?? 0) / 1000;
    return this.#millimetres;
  }

  #measured = 0;

  clear(made: Maker): void {
    this.#placer = new Placer();
    this.#items = [];
    this.#written = new Written();
    this.#lines = [];
    this.#millimetres = this.#measured = 0;
    this.isWhole = this.isFresh = this.#isOver = false;
    this.made = made;
    this.how = "run";
    this.from = 0;
  }

  /** The tape as it is kept for the next visit: its lines with their places. A long one, or a file's, is not. */
  get kept(): KeptTape | null {
    const { made, how, from } = this;
    const { length } = this.#lines;
    return made.program !== undefined && length && length <= MOST_KEPT ? { made, lines: this.#lines, how, from } : null;
  }

  /** Skips what the board still punches until its next prompt: it is no part of the next tape. */
  leave(isLeaving: boolean): void {
    this.#isLeaving = isLeaving;
  }

  /** The program that SAVE has punched since this was last asked; undefined without one. */
  takeProgram(): string | undefined {
    if (this.#work === "save" || !this.#program.length) return undefined;
    return this.#program.splice(0).join("");
  }

  /** Takes what the punch gives: blocks, stops, the end, and marks. RUN begins another tape, made by `maker`; so does a statement
   * at the prompt behind a whole tape. `begun` is called for each tape that begins; the result says whether what was there
   * before is to be drawn anew. */
  take(punched: readonly Punched[], maker: () => Maker, begun: () => void): boolean {
    let again = false;
    const begin = (how: How, from = 0): void => {
      this.clear(maker());
      this.how = how;
      this.from = from;
      this.isFresh = how !== "typed";
      begun();
      again = false;
    };
    for (const each of punched) {
      if ("mark" in each) this.#heed(each, begin);
      else if (this.#isLeaving) continue;
      else if (this.#work === "save") this.#program.push(`${each.text}\n`);
      else {
        if (this.#work === "prompt") this.#byHand(begin);
        again = this.#add(each) || again;
      }
    }
    this.#placer.settle();
    return again;
  }

  /** Shows the tape of the last visit; the board was reset since. */
  again({ made, lines, how = "run", from = 0 }: KeptTape): void {
    this.clear(made);
    this.how = how;
    this.from = from;
    for (const line of lines) this.#add(line);
    this.#placer.settle();
    this.#isOver = true;
  }

  #heed({ mark, from }: PunchMark, begin: (how: How, from: number) => void): void {
    this.#isLeaving = false;
    if (mark === "run") begin(from ? "part" : "run", from);
    if (mark === "reset") this.#isOver = true;
    this.#work = mark === "reset" ? "prompt" : mark;
  }

  /** A statement at the prompt punches: on the tape that is there, or on another one where that has its end. */
  #byHand(begin: (how: How) => void): void {
    if (this.isEmpty || this.isWhole || this.#isOver || this.made.program === undefined) begin("typed");
    else if (this.how !== "typed") this.how = "mixed";
  }

  /** Adds a line; true when the roles of those before it have changed. */
  #add({ text, line, x, y }: PunchedLine): boolean {
    if (this.#lines.length <= MOST_KEPT) this.#lines.push({ text, line, x, y });
    const block = readBlock(text);
    this.#written.add(text, Boolean(block));
    if (text === "DD") {
      this.#placer.end();
      this.isWhole = true;
      return true;
    }
    if (!block && text !== "D") return false;
    this.#items.push(block ?? "D");
    this.#placer.add(block ?? "D", line, [x, y]);
    return !block;
  }

  /** Shows a tape that comes from a file. */
  open({ items, placer, written, isWhole }: Opened, made: Maker, how: How = "run", from = 0): void {
    this.clear(made);
    this.how = how;
    this.from = from;
    this.#placer = placer;
    this.#written = written;
    this.#items = [...items];
    this.isWhole = isWhole;
  }
}
