/** The drawer over the drawing: report, blocks, program and sheet, one at a time, or none; of one height. */
import { get, onClick } from "../dom.ts";

/** One section is seen at a time: the drawer is one of them, and always open. */
const small = matchMedia("(max-width: 1000px)");

export class Drawer {
  readonly #tabs = [...document.querySelectorAll<HTMLElement>("[role=tab]")];
  readonly #opened: () => void;

  /** `opened`: another panel is seen. */
  constructor(opened: () => void) {
    this.#opened = opened;
    this.#tabs.forEach((tab, at) => {
      tab.addEventListener("click", () => {
        if (tab.ariaSelected === "true" && !small.matches) this.close();
        else this.#select(tab);
      });
      tab.addEventListener("keydown", (event) => {
        const by = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
        const next = by && this.#tabs[(at + by + this.#tabs.length) % this.#tabs.length];
        if (!next) return;
        this.#select(next);
        next.focus();
      });
    });
    onClick("shut", () => this.close());
    get("results").addEventListener("keydown", (event) => {
      if (event.key !== "Escape" || small.matches) return;
      event.stopPropagation();
      this.close();
    });
    const fit = (): void => {
      if (small.matches && get("drawer").hidden) this.open("report");
    };
    small.addEventListener("change", fit);
    fit();
  }

  open(panel: string): void {
    const tab = this.#tabs.find((each) => each.getAttribute("aria-controls") === panel);
    if (tab) this.#select(tab);
  }

  close(): void {
    const tab = this.#tabs.find(({ ariaSelected }) => ariaSelected === "true");
    if (get("drawer").contains(document.activeElement)) tab?.focus();
    this.#select(undefined);
  }

  #select(tab: HTMLElement | undefined): void {
    get("drawer").hidden = !tab;
    for (const each of this.#tabs) {
      each.ariaSelected = String(each === tab);
      each.tabIndex = each === (tab ?? this.#tabs[0]) ? 0 : -1;
      get(each.getAttribute("aria-controls") ?? "").hidden = each !== tab;
    }
    this.#opened();
  }
}
