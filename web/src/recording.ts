/** The tape that is shown: its blocks and bytes, whether it has its end, and which program made it. */
import type { Punched } from "./board.ts";
import { type Layout, Placer } from "./placed.ts";
import { type Item, itemText, readBlock } from "./tape.ts";

/** What made a tape: a program's name and text, or a file, whose program nobody knows. */
export interface Maker {
  name: string;
  program: string | undefined;
}

export interface KeptTape {
  made: Maker;
  lines: Punched[];
}

/** Lines of a tape that is kept for the next visit: some 300 KB. */
const MOST_KEPT = 5000;

export class Recording {
  #placer = new Placer();
  #items: Item[] = [];
  #pieces: string[] = [];
  #length = 0;
  #millimetres = 0;
  #isLeaving = false;
  #lines: Punched[] = [];
  /** Where in the tape's text each block begins. */
  offsets: number[] = [];
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
    if (this.#pieces.length > 1) this.#pieces = [this.#pieces.join("")];
    return this.#pieces[0] ?? "";
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
    this.#pieces = [];
    this.#lines = [];
    this.#length = this.#millimetres = this.#measured = 0;
    this.offsets = [];
    this.isWhole = this.isFresh = false;
    this.made = made;
  }

  /** The tape as it is kept for the next visit: its lines with their places. A long one, or a file's, is not. */
  get kept(): KeptTape | null {
    const { made } = this;
    return made.program !== undefined && this.#lines.length <= MOST_KEPT ? { made, lines: this.#lines } : null;
  }

  /** What is still punched by the run that is broken off is no part of the next tape. */
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
      this.#write(text, Boolean(block));
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
  open(items: readonly Item[], placer: Placer, name: string, isWhole: boolean): void {
    this.clear({ name, program: undefined });
    this.#placer = placer;
    for (const item of items) this.#write(itemText(item), item !== "D");
    if (isWhole) this.#write("DD", false);
    this.#items = [...items];
    this.isWhole = isWhole;
  }

  #write(line: string, isBlock: boolean): void {
    if (isBlock) this.offsets.push(this.#length);
    this.#pieces.push(`${line}\r\n`);
    this.#length += line.length + 2;
  }
}
