/** The tree of layers and contours: what is cut, in which order. Only the rows in sight are in the page. */
import { make } from "../dom.ts";
import { onFrame } from "../frame.ts";
import { groups } from "./alike.ts";
import type { Desk } from "./desk.ts";
import { change, isCut, type Scope } from "./edits.ts";
import { isCoarse, onCoarse } from "./look.ts";
import { alikeRow, contourRow, layerRow } from "./treerow.ts";
import type { Contour, Layer } from "./types.ts";

type Row = { layer: Layer } | { contour: Contour; isWithin: boolean } | { alike: readonly Contour[]; name: string };

/** Rows beyond those in sight. */
const BEYOND = 4;
export class Tree {
  readonly #desk: Desk;
  readonly #box: HTMLElement;
  readonly #inner = make("div", "rows");
  readonly #folded = new Set<string>();
  /** Rows of contours that are alike which are open, by their names. */
  readonly #unfolded = new Set<string>();
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
      if (!row || "layer" in row) return;
      event.preventDefault();
      const [id, ...others] = idsOf(row);
      if (id === undefined) return;
      if (!this.#desk.chosen.includes(id)) this.#desk.choose({ contours: [id, ...others] });
      this.onMenu(id, event.clientX, event.clientY);
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
    this.#rows = (state?.layers ?? []).flatMap((layer): Row[] => [{ layer }, ...this.#within(layer, contours)]);
    this.#active = Math.min(this.#active, Math.max(0, this.#rows.length - 1));
    this.#soon();
  }

  /** The rows of a layer; contours that are alike have one row. */
  #within(layer: Layer, contours: ReadonlyMap<number, Contour>): Row[] {
    if (this.#folded.has(layer.name)) return [];
    return groups(layer.contours.flatMap((id) => contours.get(id) ?? [])).flatMap((alike): Row[] => {
      const [contour] = alike;
      if (!contour || alike.length === 1) return contour ? [{ contour, isWithin: false }] : [];
      const name = `${layer.name} ${contour.kind} ${contour.size}`;
      const rows = this.#unfolded.has(name) ? alike.map((each) => ({ contour: each, isWithin: true })) : [];
      return [{ alike, name }, ...rows];
    });
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
    const element = make("div", "layer" in row ? "layer" : "alike" in row ? "alike" : "contour");
    element.role = "treeitem";
    element.id = `row-${index}`;
    element.style.top = `${index * height}px`;
    element.classList.toggle("active", index === this.#active);
    if ("layer" in row) layerRow(element, this.#desk, row.layer, this.#folded.has(row.layer.name));
    else if ("alike" in row) alikeRow(element, this.#desk, row.alike, !this.#unfolded.has(row.name));
    else contourRow(element, this.#desk, row.contour, row.isWithin);
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
    else if (classList.contains("fold")) this.#fold(row, undefined);
    else if (event.shiftKey) this.#range(before, this.#active);
    else this.#choose(row, event.ctrlKey || event.metaKey);
    this.#soon();
  }

  #choose(row: Row, more: boolean): void {
    if ("layer" in row) {
      if (row.layer.contours.length) this.#desk.choose({ layer: row.layer.name });
      return;
    }
    const ids = idsOf(row);
    const { chosen } = this.#desk;
    const others = chosen.filter((each) => !ids.includes(each));
    this.#desk.choose({ contours: !more ? ids : others.length < chosen.length ? others : [...chosen, ...ids] });
  }

  #range(from: number, to: number): void {
    const rows = this.#rows.slice(Math.min(from, to), Math.max(from, to) + 1);
    this.#desk.choose({ contours: [...new Set(rows.flatMap((row) => ("layer" in row ? [] : idsOf(row))))] });
  }

  /** Cut or not. */
  #toggle(row: Row): void {
    const { edited, contours } = this.#desk;
    if (!("layer" in row)) {
      const scope = { contours: idsOf(row) };
      const cut = !scope.contours.every((id) => isCut(edited, contours.get(id)));
      this.#desk.edit(change(edited, scope, { cut }, contours));
      return;
    }
    const { name, contours: ids } = row.layer;
    if (!ids.length) return;
    const cut = !ids.every((id) => isCut(edited, contours.get(id)));
    // (what contours of the layer wanted otherwise gives way)
    const freed = change(edited, { contours: ids.filter((id) => edited.ids.includes(id)) }, { cut: undefined }, contours);
    this.#desk.edit(change(freed, { layer: name }, { cut: cut ? undefined : false }, contours));
  }

  /** Folds a row, or not; undefined: the other way. */
  #fold(row: Row, isFolded: boolean | undefined): void {
    const flip = (names: Set<string>, name: string, isWanted: boolean | undefined): void => {
      if (isWanted ?? !names.has(name)) names.add(name);
      else names.delete(name);
    };
    if ("layer" in row) flip(this.#folded, row.layer.name, isFolded);
    else if ("alike" in row) flip(this.#unfolded, row.name, isFolded === undefined ? undefined : !isFolded);
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
      this.#fold(row, event.key === "ArrowLeft");
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
  return !("layer" in row) && idsOf(row).some((id) => scope.contours.includes(id));
}

/** The contours of a row. */
function idsOf(row: { contour: Contour } | { alike: readonly Contour[] }): number[] {
  return "alike" in row ? row.alike.map(({ id }) => id) : [row.contour.id];
}
