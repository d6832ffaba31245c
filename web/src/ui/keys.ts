/** The keys of the page, and the list of them. */
import { get, make } from "../dom.ts";
import type { Actions } from "./actions.ts";
import type { Canvas } from "./canvas.ts";
import type { Desk } from "./desk.ts";
import type { Grip } from "./handles.ts";
import { type Word, w } from "./words.ts";

const ARROWS: Record<string, readonly [number, number]> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
};
const GRIPS: Record<string, [Grip, Word]> = { h: ["start", "holdHole"], e: ["entry", "holdEntry"], t: ["tab", "holdTab"] };
const ZOOM = 1.25;

const LIST: readonly (readonly [string, Word])[] = [
  ["← →  ↑ ↓", "keyArrows"],
  ["S", "keySide"],
  ["X", "keySkip"],
  ["H  E  T", "keyHole"],
  ["R", "keyReverse"],
  ["A", "keyAlike"],
  ["Shift ⬚", "keyBox"],
  ["M", "keyMeasure"],
  ["[  ]", "keyOrder"],
  ["Shift-F10", "keyMenu"],
  ["Esc", "keyEscape"],
  ["+  −  0", "keyZoom"],
  ["Ctrl-Z  Ctrl-Y", "keyUndo"],
  ["F5", "keyCut"],
  ["Ctrl-S", "keySave"],
  ["Ctrl-O", "keyOpen"],
];

interface Doors {
  cut(): void;
  save(): void;
  open(): void;
  menu(id: number, x: number, y: number): void;
  /** Says what a held handle is moved by; undefined: nothing is held. */
  hint(word: Word | undefined): void;
}

export class Keys {
  readonly #desk: Desk;
  readonly #canvas: Canvas;
  readonly #actions: Actions;
  readonly #doors: Doors;

  constructor(desk: Desk, canvas: Canvas, actions: Actions, doors: Doors) {
    this.#desk = desk;
    this.#canvas = canvas;
    this.#actions = actions;
    this.#doors = doors;
    addEventListener("keydown", (event: KeyboardEvent) => {
      if (document.querySelector("dialog[open]")) return;
      const isDone = event.ctrlKey || event.metaKey ? this.#control(event) : event.altKey ? false : this.#plain(event);
      if (isDone) event.preventDefault();
    });
    const list = get<HTMLDialogElement>("key-list");
    get("help").addEventListener("click", () => {
      get("keys").replaceChildren(...LIST.flatMap(([keys, word]) => [make("dt", "", keys), make("dd", "", w(word))]));
      list.showModal();
    });
    get("close-keys").addEventListener("click", () => list.close());
  }

  #control(event: KeyboardEvent): boolean {
    const key = event.key.toLowerCase();
    const isText = isTyping(event);
    if (key === "s") this.#doors.save();
    else if (key === "o") this.#doors.open();
    else if (key === "z" && !isText) event.shiftKey ? this.#desk.redo() : this.#desk.undo();
    else if (key === "y" && !isText) this.#desk.redo();
    else return false;
    return true;
  }

  #plain(event: KeyboardEvent): boolean {
    if (event.key === "F5") {
      this.#doors.cut();
      return true;
    }
    const onCanvas = event.target === get("over");
    // (single letters are the drawing's and the tree's: elsewhere they mean what they always do)
    if (!onCanvas && event.target !== get("tree")) return false;
    if (onCanvas && this.#arrow(event)) return true;
    const grip = GRIPS[event.key.toLowerCase()];
    if (grip) {
      const [held, word] = grip;
      get("over").focus();
      this.#doors.hint(this.#canvas.hold(held) ? word : undefined);
      return true;
    }
    const act = this.#acts[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    act?.(event);
    return act !== undefined;
  }

  #arrow(event: KeyboardEvent): boolean {
    const way = ARROWS[event.key];
    if (!way) return false;
    if (this.#canvas.held) this.#canvas.step(way, event.shiftKey);
    else this.#actions.next(way[0] - way[1] > 0 ? 1 : -1);
    return true;
  }

  #release(): boolean {
    const isHeld = this.#canvas.held !== undefined;
    this.#canvas.hold(undefined);
    this.#doors.hint(undefined);
    return isHeld;
  }

  #menu(): void {
    const [id] = this.#desk.chosen;
    const { left, top } = get("over").getBoundingClientRect();
    if (id !== undefined) this.#doors.menu(id, left + 24, top + 24);
  }

  readonly #acts: Record<string, (event: KeyboardEvent) => void> = {
    s: () => this.#actions.side(),
    x: () => this.#actions.skip(),
    r: () => this.#actions.reverse(),
    a: () => this.#actions.alike(),
    m: () => {
      this.#canvas.isMeasuring = !this.#canvas.isMeasuring;
    },
    "[": () => void this.#actions.order(-1),
    "]": () => void this.#actions.order(1),
    "+": () => this.#canvas.zoom(ZOOM),
    "=": () => this.#canvas.zoom(ZOOM),
    "-": () => this.#canvas.zoom(1 / ZOOM),
    "0": () => this.#canvas.fit(),
    Enter: () => void this.#release(),
    Escape: () => {
      if (this.#canvas.isMeasuring) this.#canvas.isMeasuring = false;
      else if (!this.#release()) this.#desk.choose("all");
    },
    ContextMenu: () => this.#menu(),
    F10: (event) => {
      if (event.shiftKey) this.#menu();
    },
  };
}

function isTyping({ target }: KeyboardEvent): boolean {
  return target instanceof HTMLInputElement && target.type === "text";
}
