/** Tries the editor's text on the machine's second board, and marks what it would not take. */
import type { Editor, Mark } from "./editor.ts";
import { isWord, t } from "./language.ts";
import { faultsOf } from "./language-skg.ts";
import type { Session } from "./session.ts";

/** The manual's chapter of errors. */
const ERRORS = 11;

export class Proof {
  readonly #editor: Editor;
  readonly #openManual: (chapter: number) => void;

  constructor(editor: Editor, openManual: (chapter: number) => void) {
    this.#editor = editor;
    this.#openManual = openManual;
  }

  /** Marks what the machine would not take of the text; true when it takes all of it. A file may hold commands, too: lines
   * without a number. */
  async check(session: Session, mayCommand = false): Promise<boolean> {
    const { text } = this.#editor;
    const found = faultsOf(text).filter(({ word }) => !mayCommand || word !== "noNumber");
    const faults = found.map(({ row, column, word, value }): Mark => ({ row, column, text: t(word, value) }));
    const refused = (await session.check(text)).map(({ row, error, column }) =>
      this.#mark(row, String(error).padStart(2, "0"), column),
    );
    if (text !== this.#editor.text) return false;
    const rows = new Set(faults.map(({ row }) => row));
    const marks = [...faults, ...refused.filter(({ row }) => !rows.has(row))].sort((a, b) => a.row - b.row);
    this.#editor.marks = marks;
    return !marks.length;
  }

  /** Marks the line in which a run ended; true when the text has it. */
  ended(number: string, line: number): boolean {
    const row = this.#editor.rowOf(line);
    if (row >= 0) this.#editor.marks = [this.#mark(row, number)];
    return row >= 0;
  }

  #mark(row: number, number: string, column = -1): Mark {
    const word = `err${number}`;
    const more = { label: t("manual"), open: () => this.#openManual(ERRORS) };
    return { row, column, text: t("ended", number, isWord(word) ? t(word) : ""), more };
  }
}
