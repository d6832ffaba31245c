/** The tape that is shown: its blocks and bytes, whether it has its end, and which program made it. */
import type { Punched } from "./board.ts";
import { type Layout, Placer } from "./placed.ts";
import { type Item, readBlock } from "./tape.ts";
import { Written } from "./written.ts";

/** The maker of a tape: a program's name and text, or a file, whose program is unknown. */
export interface Maker {
  name: string;
  program: string | undefined;
}

export interface KeptTape {
  made: Maker;
  lines: Punched[];
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
  #lines: Punched[] = [];
  /** It has its DD. A tape without it was broken off, is not punched to its end, or came so from a file. */
  isWhole = false;
  made: Maker = { name: "part", program: undefined };
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
    this.isWhole = this.isFresh = false;
    this.made = made;
  }

  /** The tape as it is kept for the next visit: its lines with their places. A long one, or a file's, is not. */
  get kept(): KeptTape | null {
    const { made } = this;
    return made.program !== undefined && this.#lines.length <= MOST_KEPT ? { made, lines: this.#lines } : null;
  }

  /** Skips the rest of a run that is broken off: it is no part of the next tape. */
  leave(isLeaving: boolean): void {
    this.#isLeaving = isLeaving;
  }

  /** Takes lines of the punch: blocks, stops, the end; RUN: another tape begins, made by `maker`. `begun` is called for each
   * tape that begins; the result says whether what was there before is to be drawn anew. */
  take(punched: readonly Punched[], maker: () => Maker, begun: () => void): boolean {
    let again = false;
    const begin = (isRun: boolean): void => {
      this.clear(maker());
      this.isFresh = isRun;
      begun();
      again = false;
    };
    for (const { text, line, x, y } of punched) {
      if (text === "RUN") {
        this.#isLeaving = false;
        begin(true);
        continue;
      }
      if (this.#isLeaving) continue;
      if (this.isWhole) begin(false); // (direct statements after a tape's end)
      if (this.#lines.length <= MOST_KEPT) this.#lines.push({ text, line, x, y });
      const block = readBlock(text);
      this.#written.add(text, Boolean(block));
      if (text === "DD") {
        this.#placer.end();
        this.isWhole = again = true;
      } else if (block || text === "D") {
        this.#items.push(block ?? "D");
        this.#placer.add(block ?? "D", line, [x, y]);
        again ||= !block;
      }
    }
    this.#placer.settle();
    return again;
  }

  /** Shows a tape that comes from a file. */
  open({ items, placer, written, isWhole }: Opened, name: string): void {
    this.clear({ name, program: undefined });
    this.#placer = placer;
    this.#written = written;
    this.#items = [...items];
    this.isWhole = isWhole;
  }
}
