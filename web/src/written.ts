/** A tape's text, byte for byte as it is punched, and where in it each block begins. */
import { type Item, itemText, STEP } from "./tape.ts";

export class Written {
  #pieces: string[] = [];
  #length = 0;
  readonly offsets: number[] = [];

  get text(): string {
    if (this.#pieces.length > 1) this.#pieces = [this.#pieces.join("")];
    return this.#pieces[0] ?? "";
  }

  add(line: string, isBlock: boolean): void {
    if (isBlock) this.offsets.push(this.#length);
    this.#pieces.push(`${line}\r\n`);
    this.#length += line.length + 2;
  }
}

/** Writes a tape, in steps of some hundred blocks. */
export function* writeSteps(items: readonly Item[], isWhole: boolean): Generator<undefined, Written> {
  const written = new Written();
  for (const [at, item] of items.entries()) {
    if (at % STEP === STEP - 1) yield;
    written.add(itemText(item), item !== "D");
  }
  if (isWhole) written.add("DD", false);
  return written;
}
