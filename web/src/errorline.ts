/** The lines of errors on the paper, which comes in pieces. */

/** So much of the paper may stand in front of the rest of such a line. */
const TAIL = 400;

export class ErrorLines {
  readonly #tell: (number: string, line: number) => void;
  #tail = "";

  /** `tell`: an ERR and its LINE, 0 without one. */
  constructor(tell: (number: string, line: number) => void) {
    this.#tell = tell;
  }

  /** Takes the next piece, and tells the last ERR that is whole with it. */
  read(paper: string): void {
    this.#tail = (this.#tail + paper).slice(-TAIL);
    const line = [...this.#tail.matchAll(/(?:^|\n)ERR (\d\d)(?: LINE (\d+))?\r\n/g)].at(-1);
    if (!line) return;
    this.#tail = this.#tail.slice((line.index ?? 0) + line[0].length);
    this.#tell(line[1] ?? "", Number(line[2] ?? 0));
  }
}
