/** The list of a tape's blocks, however long: only the rows in sight are in the page. */
import type { Chooser } from "./choice.ts";
import { chosenBlocks } from "./drawing.ts";
import { onFrame } from "./frame.ts";
import { type Layout, nothing } from "./placed.ts";
import { blockText } from "./tape.ts";

const ROW = 24;

export class BlockList {
  readonly #box: HTMLElement;
  readonly #inner: HTMLElement;
  readonly #chooser: Chooser;
  #layout: Layout = nothing();
  readonly #ask = onFrame(() => this.#draw());
  /** The text of a row about the line that made its block, and about a stop after it. */
  describe: (line: number, stop: boolean) => string = () => "";

  /** `box`: a scrolling element with role listbox. */
  constructor(box: HTMLElement, chooser: Chooser) {
    this.#box = box;
    this.#chooser = chooser;
    this.#inner = document.createElement("div");
    this.#inner.className = "rows";
    this.#inner.role = "presentation";
    box.append(this.#inner);
    box.addEventListener("scroll", () => this.#ask());
    new ResizeObserver(() => this.#ask()).observe(box);
    box.addEventListener("keydown", (event) => this.#key(event));
    box.addEventListener("pointermove", (event) => this.#point(event));
    box.addEventListener("click", (event) => this.#point(event));
    chooser.onChange((choice, by) => {
      const [first] = chosenBlocks(choice, this.#layout.blocks);
      if (by !== this && first !== undefined) this.#scrollTo(first);
      this.#ask();
    });
  }

  show(layout: Layout): void {
    this.#layout = layout;
    this.#box.scrollTop = 0;
    this.#ask();
  }

  /** There are more blocks; the last one is brought into sight. */
  grown(follow: boolean): void {
    this.#inner.style.height = `${this.#layout.blocks.length * ROW}px`;
    if (follow) this.#box.scrollTop = this.#inner.offsetHeight;
    this.#ask();
  }

  #draw(): void {
    const { blocks, stops } = this.#layout;
    this.#inner.style.height = `${blocks.length * ROW}px`;
    const first = Math.max(0, Math.floor(this.#box.scrollTop / ROW) - 2);
    const last = Math.min(blocks.length, Math.ceil((this.#box.scrollTop + this.#box.clientHeight) / ROW) + 2);
    const chosen = chosenBlocks(this.#chooser.choice, blocks);
    const rows: HTMLElement[] = [];
    for (const placed of blocks.slice(first, last)) {
      const row = document.createElement("div");
      row.role = "option";
      row.id = `block-${placed.number}`;
      row.style.top = `${(placed.number - 1) * ROW}px`;
      row.ariaPosInSet = String(placed.number);
      row.ariaSetSize = String(blocks.length);
      const isChosen = chosen.has(placed.number);
      row.ariaSelected = String(isChosen);
      const stop = stops.some(({ after }) => after === placed.number);
      for (const [name, text] of [
        ["number", String(placed.number).padStart(4, "0")],
        ["text", blockText(placed.block)],
        ["line", this.describe(placed.line, stop)],
      ] as const) {
        const part = document.createElement("span");
        part.className = name;
        part.textContent = text;
        row.append(part);
      }
      rows.push(row);
    }
    this.#inner.replaceChildren(...rows);
    const { choice } = this.#chooser;
    const active = choice && "block" in choice ? choice.block : [...chosen][0];
    if (active !== undefined) this.#box.setAttribute("aria-activedescendant", `block-${active}`);
    else this.#box.removeAttribute("aria-activedescendant");
  }

  #scrollTo(number: number): void {
    const top = (number - 1) * ROW;
    const { scrollTop, clientHeight } = this.#box;
    if (top < scrollTop) this.#box.scrollTop = top;
    else if (top + ROW > scrollTop + clientHeight) this.#box.scrollTop = top + ROW - clientHeight;
  }

  #point(event: MouseEvent): void {
    const row = (event.target as HTMLElement).closest("[role=option]");
    if (row) this.#chooser.choose({ block: Number(row.id.slice("block-".length)) }, this);
  }

  #key(event: KeyboardEvent): void {
    const { blocks } = this.#layout;
    const page = Math.max(1, Math.floor(this.#box.clientHeight / ROW) - 1);
    const { choice } = this.#chooser;
    const now = choice && "block" in choice ? choice.block : 0;
    const goal = {
      ArrowDown: now + 1,
      ArrowUp: now - 1,
      PageDown: now + page,
      PageUp: now - page,
      Home: 1,
      End: blocks.length,
    }[event.key];
    if (goal === undefined || !blocks.length) return;
    event.preventDefault();
    this.#chooser.choose({ block: Math.min(blocks.length, Math.max(1, goal)) });
  }
}
