/** The selection: a block, or all blocks of a program line. Drawing, block list and program show it alike. */

export type Choice = { block: number } | { line: number } | undefined;

export class Chooser {
  #choice: Choice;
  readonly #listeners: ((choice: Choice, by: object | undefined) => void)[] = [];

  get choice(): Choice {
    return this.#choice;
  }

  /** `by`: who chose, and need not be told where to scroll. */
  choose(choice: Choice, by?: object): void {
    if (JSON.stringify(choice) === JSON.stringify(this.#choice)) return;
    this.#choice = choice;
    for (const listener of this.#listeners) listener(choice, by);
  }

  onChange(listener: (choice: Choice, by: object | undefined) => void): void {
    this.#listeners.push(listener);
  }
}
