/** The tree of layers and contours: what is cut, in which order. Only the rows in sight are in the page. */
import { make } from "../dom.ts";
import { onFrame } from "../frame.ts";
import type { Desk } from "./desk.ts";
import { change, isCut, type Scope } from "./edits.ts";
import { isCoarse, onCoarse } from "./look.ts";
import { contourRow, layerRow } from "./treerow.ts";
import type { Contour, Layer } from "./types.ts";

type Row = { layer: Layer } | { contour: Contour };

/** Rows beyond those in sight. */
const BEYOND = 4;
export class Tree {
  readonly #desk: Desk;
  readonly #box: HTMLElement;
  readonly #inner = make("div", "rows");
  readonly #folded = new Set<string>();
  #rows: Row[] = [];
  /** The row that keys are meant for. */
  #active = 0;
  #dragged: number | undefined;
  readonly #soon = onFrame(() => this.#draw());
  /** A row is asked for what can be done with it. */
  onMenu: (id: number, x: number, y: number) => void = () => undefined;
  /** A contour takes the place of another in the order. */
  onOrder: (id: number, before: number) => void = () => undefined;

  constructor(box: HTMLElement, desk: Desk) {
    this.#box = box;
    this.#desk = desk;
    this.#inner.role = "presentation";
    box.append(this.#inner);
    box.addEventListener("scroll", this.#soon);
    new ResizeObserver(this.#soon).observe(box);
    onCoarse(this.#soon);
    box.addEventListener("click", (event) => this.#click(event));
    box.addEventListener("keydown", (event) => this.#key(event));
    box.addEventListener("contextmenu", (event) => {
      const row = this.#rowOf(event);
      if (!row || !("contour" in row)) return;
      event.preventDefault();
      if (!this.#desk.chosen.includes(row.contour.id)) this.#desk.choose({ contours: [row.contour.id] });
      this.onMenu(row.contour.id, event.clientX, event.clientY);
    });
    this.#listenToDrags();
    desk.onChange((news) => {
      if (news.has("drawing")) this.#list();
      if (news.has("selection")) this.#follow();
      this.#soon();
    });
  }

  /** In the present language. */
  name(): void {
    this.#soon();
  }

  get #rowHeight(): number {
    return isCoarse() ? 44 : 28;
  }

  #list(): void {
    const { state, contours } = this.#desk;
    this.#rows = (state?.layers ?? []).flatMap((layer): Row[] => [
      { layer },
      ...(this.#folded.has(layer.name) ? [] : layer.contours).flatMap((id): Row[] => {
        const contour = contours.get(id);
        return contour ? [{ contour }] : [];
      }),
    ]);
    this.#active = Math.min(this.#active, Math.max(0, this.#rows.length - 1));
    this.#soon();
  }

  /** Brings what was chosen elsewhere into sight. */
  #follow(): void {
    const { scope } = this.#desk;
    const index = this.#rows.findIndex((row) => isOf(row, scope));
    if (index < 0 || isOf(this.#rows[this.#active], scope)) return;
    this.#active = index;
    this.#scrollTo(index);
  }

  #scrollTo(index: number): void {
    const [top, bottom] = [index * this.#rowHeight, (index + 1) * this.#rowHeight];
    const { scrollTop, clientHeight } = this.#box;
    if (top < scrollTop) this.#box.scrollTop = top;
    else if (bottom > scrollTop + clientHeight) this.#box.scrollTop = bottom - clientHeight;
  }

  #draw(): void {
    const height = this.#rowHeight;
    const { scrollTop, clientHeight } = this.#box;
    this.#inner.style.height = `${this.#rows.length * height}px`;
    const first = Math.max(0, Math.floor(scrollTop / height) - BEYOND);
    const last = Math.min(this.#rows.length, Math.ceil((scrollTop + clientHeight) / height) + BEYOND);
    this.#inner.replaceChildren(...this.#rows.slice(first, last).map((row, at) => this.#row(row, first + at, height)));
    if (this.#rows.length) this.#box.setAttribute("aria-activedescendant", `row-${this.#active}`);
    else this.#box.removeAttribute("aria-activedescendant");
  }

  #row(row: Row, index: number, height: number): HTMLElement {
    const element = make("div", "layer" in row ? "layer" : "contour");
    element.role = "treeitem";
    element.id = `row-${index}`;
    element.style.top = `${index * height}px`;
    element.classList.toggle("active", index === this.#active);
    if ("layer" in row) layerRow(element, this.#desk, row.layer, this.#folded.has(row.layer.name));
    else contourRow(element, this.#desk, row.contour);
    return element;
  }

  #rowOf(event: Event): Row | undefined {
    const element = (event.target as HTMLElement).closest("[role=treeitem]");
    return element ? this.#rows[Number(element.id.slice("row-".length))] : undefined;
  }

  #click(event: MouseEvent): void {
    const row = this.#rowOf(event);
    if (!row) return;
    const before = this.#active;
    this.#active = this.#rows.indexOf(row);
    const { classList } = event.target as HTMLElement;
    if (classList.contains("check")) this.#toggle(row);
    else if (classList.contains("fold") && "layer" in row) this.#fold(row.layer, !this.#folded.has(row.layer.name));
    else if (event.shiftKey) this.#range(before, this.#active);
    else this.#choose(row, event.ctrlKey || event.metaKey);
    this.#soon();
  }

  #choose(row: Row, more: boolean): void {
    if ("layer" in row) {
      if (row.layer.contours.length) this.#desk.choose({ layer: row.layer.name });
      return;
    }
    const { id } = row.contour;
    const { chosen } = this.#desk;
    const others = chosen.filter((each) => each !== id);
    this.#desk.choose({ contours: !more ? [id] : others.length < chosen.length ? others : [...chosen, id] });
  }

  #range(from: number, to: number): void {
    const rows = this.#rows.slice(Math.min(from, to), Math.max(from, to) + 1);
    this.#desk.choose({ contours: rows.flatMap((row) => ("contour" in row ? [row.contour.id] : [])) });
  }

  /** Cut or not. */
  #toggle(row: Row): void {
    const { edited, contours } = this.#desk;
    if ("contour" in row) {
      const scope = { contours: [row.contour.id] };
      this.#desk.edit(change(edited, scope, { cut: !isCut(edited, row.contour) }, contours));
      return;
    }
    const { name, contours: ids } = row.layer;
    if (!ids.length) return;
    const cut = !ids.every((id) => isCut(edited, contours.get(id)));
    // (what contours of the layer wanted otherwise gives way)
    const freed = change(edited, { contours: ids.filter((id) => edited.ids.includes(id)) }, { cut: undefined }, contours);
    this.#desk.edit(change(freed, { layer: name }, { cut: cut ? undefined : false }, contours));
  }

  #fold(layer: Layer, isFolded: boolean): void {
    if (isFolded) this.#folded.add(layer.name);
    else this.#folded.delete(layer.name);
    this.#list();
  }

  #key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const row = this.#rows[this.#active];
    if (!row) return;
    const page = Math.max(1, Math.floor(this.#box.clientHeight / this.#rowHeight) - 1);
    const goal = {
      ArrowDown: this.#active + 1,
      ArrowUp: this.#active - 1,
      PageDown: this.#active + page,
      PageUp: this.#active - page,
      Home: 0,
      End: this.#rows.length - 1,
    }[event.key];
    if (goal !== undefined) {
      const before = this.#active;
      this.#active = Math.max(0, Math.min(this.#rows.length - 1, goal));
      const next = this.#rows[this.#active] as Row;
      if (event.shiftKey) this.#range(before, this.#active);
      else this.#choose(next, false);
      this.#scrollTo(this.#active);
    } else if (event.key === " ") {
      this.#toggle(row);
    } else if (event.key === "ArrowLeft" || event.key === "ArrowRight") {
      if ("layer" in row) this.#fold(row.layer, event.key === "ArrowLeft");
    } else {
      return;
    }
    event.preventDefault();
    event.stopPropagation();
    this.#soon();
  }

  /** A contour is dragged to another place in the order. */
  #listenToDrags(): void {
    const box = this.#box;
    const target = (event: DragEvent): HTMLElement | null => (event.target as HTMLElement).closest?.("[data-id]") ?? null;
    box.addEventListener("dragstart", (event) => {
      this.#dragged = Number(target(event)?.dataset["id"]);
      event.dataTransfer?.setData("text/plain", String(this.#dragged));
    });
    box.addEventListener("dragover", (event) => {
      const over = target(event);
      if (this.#dragged === undefined || !over) return;
      event.preventDefault();
      for (const each of box.querySelectorAll(".goal")) each.classList.remove("goal");
      over.classList.add("goal");
    });
    box.addEventListener("drop", (event) => {
      const over = target(event);
      if (this.#dragged === undefined || !over) return;
      event.preventDefault();
      event.stopPropagation();
      this.onOrder(this.#dragged, Number(over.dataset["id"]));
    });
    box.addEventListener("dragend", () => {
      this.#dragged = undefined;
      for (const each of box.querySelectorAll(".goal")) each.classList.remove("goal");
    });
  }
}

function isOf(row: Row | undefined, scope: Scope): boolean {
  if (!row || scope === "all") return false;
  if ("layer" in scope) return "layer" in row && row.layer.name === scope.layer;
  return "contour" in row && scope.contours.includes(row.contour.id);
}
