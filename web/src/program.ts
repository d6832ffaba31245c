/** The program that is in the machine: its lines, linked with the blocks that they made; or a text to edit. */
import type { Chooser } from "./choice.ts";
import type { Layout } from "./placed.ts";

export class ProgramView {
  readonly #box: HTMLElement;
  readonly #chooser: Chooser;
  #text = "";
  #blocks: () => Layout;
  #wrong = 0;

  /** `box`: a scrolling element with role listbox. */
  constructor(box: HTMLElement, chooser: Chooser, blocks: () => Layout) {
    this.#box = box;
    this.#chooser = chooser;
    this.#blocks = blocks;
    const point = (event: MouseEvent): void => {
      const row = (event.target as HTMLElement).closest<HTMLElement>("[role=option]");
      if (row) chooser.choose({ line: Number(row.dataset["line"]) }, this);
    };
    box.addEventListener("pointermove", point);
    box.addEventListener("click", point);
    box.addEventListener("keydown", (event) => this.#key(event));
    chooser.onChange((_, by) => this.#mark(by !== this));
  }

  get text(): string {
    return this.#text;
  }

  set text(text: string) {
    if (text === this.#text) return;
    this.#text = text;
    this.#box.replaceChildren(...text.split("\n").filter(Boolean).map((line) => {
      const row = document.createElement("div");
      row.role = "option";
      const number = /^\d+/.exec(line)?.[0] ?? "0";
      row.dataset["line"] = number;
      row.id = `line-${number}`;
      row.textContent = line;
      return row;
    }));
    this.#mark(false);
  }

  /** The line that ended in an ERR; 0: none. */
  set wrong(line: number) {
    this.#wrong = line;
    this.#mark(false);
    if (line) this.#row(line)?.scrollIntoView({ block: "nearest" });
  }

  #row(line: number): HTMLElement | null {
    return this.#box.querySelector(`#line-${line}`);
  }

  /** The line that the choice means. */
  get #line(): number {
    const { choice } = this.#chooser;
    if (!choice) return 0;
    return "line" in choice ? choice.line : this.#blocks().blocks[choice.block - 1]?.line ?? 0;
  }

  #mark(scroll: boolean): void {
    const chosen = this.#line;
    for (const row of this.#box.children as Iterable<HTMLElement> & HTMLCollection) {
      const line = Number(row.dataset["line"]);
      row.ariaSelected = String(line === chosen);
      row.classList.toggle("wrong", line === this.#wrong);
    }
    const row = chosen ? this.#row(chosen) : null;
    if (row) this.#box.setAttribute("aria-activedescendant", row.id);
    else this.#box.removeAttribute("aria-activedescendant");
    if (row && scroll) {
      const [top, height] = [row.offsetTop - this.#box.offsetTop, row.offsetHeight];
      if (top < this.#box.scrollTop) this.#box.scrollTop = top;
      else if (top + height > this.#box.scrollTop + this.#box.clientHeight) {
        this.#box.scrollTop = top + height - this.#box.clientHeight;
      }
    }
  }

  #key(event: KeyboardEvent): void {
    const rows = [...this.#box.children] as HTMLElement[];
    const now = rows.findIndex((row) => Number(row.dataset["line"]) === this.#line);
    const goal = { ArrowDown: now + 1, ArrowUp: now - 1, Home: 0, End: rows.length - 1 }[event.key];
    const row = goal === undefined ? undefined : rows[Math.max(0, Math.min(rows.length - 1, goal))];
    if (!row) return;
    event.preventDefault();
    this.#chooser.choose({ line: Number(row.dataset["line"]) });
  }
}
