/** The program as a text to edit in place: its words coloured, what is wrong said below its line, lines linked with blocks. */
import { defaultKeymap, history, historyKeymap, undo } from "@codemirror/commands";
import { EditorState, StateEffect, StateField, Transaction } from "@codemirror/state";
import { Decoration, type DecorationSet, drawSelection, EditorView, keymap, WidgetType } from "@codemirror/view";
import type { Chooser } from "./choice.ts";
import { nextNumber, skg } from "./language-skg.ts";
import type { Layout } from "./placed.ts";
import { OTHERS, withSigns } from "./signs.ts";

/** An error in a line: its place in the text from 0, the column or -1, the sentence, and a button for more about it. */
export interface Mark {
  row: number;
  column: number;
  text: string;
  more?: { label: string; open: () => void };
}

/** A number to change: its program line, its column, and what is said of it below. */
export interface Tip {
  line: number;
  column: number;
  text: string;
}

const setTip = StateEffect.define<Tip | undefined>();
const setMarks = StateEffect.define<readonly Mark[]>();
const setLine = StateEffect.define<number>();

/** A sentence below a line, from a column on. */
function below(kind: string, column: number, text: string): HTMLElement {
  const box = document.createElement("div");
  box.className = kind;
  box.style.setProperty("--at", String(Math.max(0, column)));
  const words = document.createElement("span");
  words.textContent = text;
  box.append(words);
  return box;
}

class Sentence extends WidgetType {
  readonly #mark: Mark;

  constructor(mark: Mark) {
    super();
    this.#mark = mark;
  }

  override eq(other: Sentence): boolean {
    return other.#mark.text === this.#mark.text && other.#mark.column === this.#mark.column;
  }

  override toDOM(): HTMLElement {
    const { column, text } = this.#mark;
    const box = below("fault", column, column >= 0 ? `↑ ${text} ` : `${text} `);
    const { more } = this.#mark;
    if (more) {
      const button = document.createElement("button");
      button.type = "button";
      button.textContent = more.label;
      button.addEventListener("click", more.open);
      box.firstElementChild?.append(button);
    }
    return box;
  }
}

function decorations(state: EditorState, marks: readonly Mark[]): DecorationSet {
  return Decoration.set(
    marks.flatMap((mark) => {
      if (mark.row >= state.doc.lines) return [];
      const line = state.doc.line(mark.row + 1);
      return [
        Decoration.line({ class: "wrong", attributes: { "aria-invalid": "true" } }).range(line.from),
        Decoration.widget({ widget: new Sentence(mark), block: true, side: 1 }).range(line.to),
      ];
    }),
    true,
  );
}

class Advice extends WidgetType {
  readonly #tip: Tip;

  constructor(tip: Tip) {
    super();
    this.#tip = tip;
  }

  override eq(other: Advice): boolean {
    return other.#tip.text === this.#tip.text && other.#tip.column === this.#tip.column;
  }

  override toDOM(): HTMLElement {
    return below("tip", this.#tip.column, `↑ ${this.#tip.text}`);
  }
}

/** It goes away at the first change of its line. */
const tips = StateField.define<DecorationSet>({
  create: () => Decoration.none,
  update(value, transaction) {
    const effect = transaction.effects.find((each) => each.is(setTip));
    if (!effect) {
      const isTouched = (from: number, to: number): boolean => {
        let touched = false;
        value.between(0, transaction.startState.doc.length, (at) => {
          const line = transaction.startState.doc.lineAt(at);
          touched ||= from <= line.to && to >= line.from;
        });
        return touched;
      };
      let isGone = false;
      transaction.changes.iterChangedRanges((from, to) => (isGone ||= isTouched(from, to)));
      return isGone ? Decoration.none : value.map(transaction.changes);
    }
    const tip: Tip | undefined = effect.value;
    const row = tip && rowOf(transaction.state, tip.line);
    if (!tip || !row) return Decoration.none;
    const { to } = transaction.state.doc.line(row.number);
    return Decoration.set([Decoration.widget({ widget: new Advice(tip), block: true, side: 1 }).range(to)]);
  },
  provide: (field) => EditorView.decorations.from(field),
});

const faults = StateField.define<DecorationSet>({
  create: () => Decoration.none,
  update(value, transaction) {
    const effect = transaction.effects.find((each) => each.is(setMarks));
    return effect ? decorations(transaction.state, effect.value) : value.map(transaction.changes);
  },
  provide: (field) => EditorView.decorations.from(field),
});

const chosen = Decoration.line({ class: "chosen" });
const chosenLine = StateField.define<DecorationSet>({
  create: () => Decoration.none,
  update(value, transaction) {
    const effect = transaction.effects.find((each) => each.is(setLine));
    if (!effect) return value.map(transaction.changes);
    const row = rowOf(transaction.state, effect.value);
    return row ? Decoration.set([chosen.range(row.from)]) : Decoration.none;
  },
  provide: (field) => EditorView.decorations.from(field),
});

const numberOf = (text: string): number => Number(/^\s*(\d+)/.exec(text)?.[1] ?? 0);

function rowOf(state: EditorState, number: number): { from: number; number: number } | undefined {
  if (!number) return undefined;
  for (let at = 1; at <= state.doc.lines; at++) if (numberOf(state.doc.line(at).text) === number) return state.doc.line(at);
  return undefined;
}

/** RETURN begins the next line with its number. */
function newLine(view: EditorView): boolean {
  const { state } = view;
  const line = state.doc.lineAt(state.selection.main.head);
  if (state.selection.main.head !== line.to || !line.text.trim()) return false;
  const number = nextNumber(line.text, line.number < state.doc.lines ? state.doc.line(line.number + 1).text : "");
  if (number === undefined) return false;
  const insert = `\n${number} `;
  view.dispatch({
    changes: { from: line.to, insert },
    selection: { anchor: line.to + insert.length },
    scrollIntoView: true,
    userEvent: "input",
  });
  return true;
}

export interface Listener {
  /** The visitor has changed the text. */
  changed(): void;
  /** Ctrl-Enter. */
  run(): void;
}

export class Editor {
  readonly #view: EditorView;

  constructor(box: HTMLElement, chooser: Chooser, blocks: () => Layout, listener: Listener) {
    const runs = (): boolean => {
      listener.run();
      return true;
    };
    const line = (): number => {
      const { choice } = chooser;
      if (!choice) return 0;
      return "line" in choice ? choice.line : (blocks().blocks[choice.block - 1]?.line ?? 0);
    };
    this.#view = new EditorView({
      parent: box,
      state: EditorState.create({
        extensions: [
          history(),
          drawSelection(),
          keymap.of([{ key: "Mod-Enter", run: runs }, { key: "Enter", run: newLine }, ...historyKeymap, ...defaultKeymap]),
          skg,
          faults,
          tips,
          chosenLine,
          EditorView.contentAttributes.of({ id: "text", tabindex: "0", autocapitalize: "characters", spellcheck: "false" }),
          EditorView.updateListener.of((update) => {
            if (update.docChanged && !update.transactions.some((each) => each.annotation(Transaction.remote))) listener.changed();
            if (update.selectionSet && update.view.hasFocus) this.#choose(chooser, update.state.selection.main.head);
          }),
          EditorView.domEventHandlers({
            mousemove: (event, view) => {
              const at = view.posAtCoords({ x: event.clientX, y: event.clientY });
              if (at !== null && !event.buttons) this.#choose(chooser, at);
            },
          }),
        ],
      }),
    });
    chooser.onChange((_, by) => {
      const row = rowOf(this.#view.state, line());
      const scroll = row && by !== this && !this.#view.hasFocus ? [EditorView.scrollIntoView(row.from)] : [];
      this.#view.dispatch({ effects: [setLine.of(line()), ...scroll] });
    });
  }

  #choose(chooser: Chooser, at: number): void {
    const number = numberOf(this.#view.state.doc.lineAt(at).text);
    if (number) chooser.choose({ line: number }, this);
  }

  get text(): string {
    const text = this.#view.state.doc.toString();
    return text && !text.endsWith("\n") ? `${text}\n` : text;
  }

  /** Another text, for undo one step; what it has in common with the present one stays where it is. */
  set text(text: string) {
    const [before, after] = [this.#view.state.doc.toString(), text.replace(/\r\n?/g, "\n").replace(/\n$/, "")];
    if (before === after) return;
    let from = 0;
    while (from < before.length && before[from] === after[from]) from++;
    let [to, end] = [before.length, after.length];
    while (to > from && end > from && before[to - 1] === after[end - 1]) {
      to--;
      end--;
    }
    this.#view.dispatch({ changes: { from, to, insert: after.slice(from, end) }, annotations: Transaction.remote.of(true) });
  }

  /** Its name for screen readers. */
  set name(name: string) {
    this.#view.contentDOM.setAttribute("aria-label", name);
  }

  set marks(marks: readonly Mark[]) {
    this.#view.dispatch({ effects: setMarks.of(marks) });
    const [first] = marks;
    if (first && !this.#view.hasFocus && first.row < this.#view.state.doc.lines) {
      this.#view.dispatch({ effects: EditorView.scrollIntoView(this.#view.state.doc.line(first.row + 1).from) });
    }
  }

  /** Says below a line which number of it may be changed, until the line is. */
  set tip(tip: Tip | undefined) {
    this.#view.dispatch({ effects: setTip.of(tip) });
  }

  /** The place of a program line in the text, from 0; -1 where there is none. */
  rowOf(number: number): number {
    return (rowOf(this.#view.state, number)?.number ?? 0) - 1;
  }

  /** A word is being put together with an input method: its text is left alone until it is there. */
  get isComposing(): boolean {
    return this.#view.composing;
  }

  /** Other forms of ASCII signs, ＝（−, become those that the machine has; who types stays where he is. */
  narrow(): void {
    const changes = [...this.#view.state.doc.toString().matchAll(OTHERS)].map(({ index, 0: sign }) => ({
      from: index,
      to: index + 1,
      insert: withSigns(sign),
    }));
    const annotations = [Transaction.remote.of(true), Transaction.addToHistory.of(false)];
    if (changes.length) this.#view.dispatch({ changes, annotations });
  }

  get hasFocus(): boolean {
    return this.#view.hasFocus;
  }

  focus(): void {
    this.#view.focus();
  }

  undo(): void {
    undo(this.#view);
  }
}
