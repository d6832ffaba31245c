/** The panel of what is chosen: contours, a layer, or everything. */
import { get } from "../dom.ts";
import { alikeTo } from "./alike.ts";
import type { Desk } from "./desk.ts";
import { type Change, change, isCut, own, reset } from "./edits.ts";
import { Field, type Plan, same, type Value } from "./inputs.ts";
import { titleOf } from "./treerow.ts";
import type { Planned, Wanted } from "./types.ts";
import { w } from "./words.ts";

type Key = keyof Wanted;

/** Settings of single contours only, and settings that the whole drawing has not (its offset is the machine's). */
const SINGLE: ReadonlySet<Key> = new Set(["start", "entry", "order"]);
const NOT_ALL: ReadonlySet<Key> = new Set(["cut", "offset"]);
const NOT_SINGLE: ReadonlySet<Key> = new Set(["slug_tab"]);
const USUAL: Wanted = {
  cut: true,
  side: "auto",
  passes: [0],
  tab: 0,
  slug_tab: 0,
  tabs: 1,
  tab_passes: [],
  overlap: 0,
  lead: 3,
  lead_shape: "perpendicular",
  reverse: false,
  clearance_on: "punch",
};

/** Of more contours nobody asks for those that are alike. */
const MOST_CHOSEN = 20;

const PLANS: readonly (Plan & { key: Key })[] = [
  { key: "cut", label: "cut", kind: "switch" },
  {
    key: "side",
    label: "side",
    kind: "choice",
    options: [
      ["auto", "sideAuto"],
      ["inside", "sideInside"],
      ["outside", "sideOutside"],
      ["left", "sideLeft"],
      ["right", "sideRight"],
      ["on", "sideOn"],
    ],
  },
  { key: "offset", label: "offset", kind: "number", unit: "mm", example: "0.1" },
  { key: "passes", label: "passes", kind: "list", unit: "mm", example: "0.06, 0.02, 0" },
  { key: "tab", label: "tab", kind: "number", unit: "mm", example: "1.5" },
  { key: "slug_tab", label: "slugTab", kind: "number", unit: "mm", example: "1.5" },
  { key: "tabs", label: "tabs", kind: "whole", example: "2" },
  { key: "tab_passes", label: "tabPasses", kind: "list", unit: "mm", example: "0.02, 0" },
  { key: "overlap", label: "overlap", kind: "number", unit: "mm", example: "0.3" },
  { key: "lead", label: "lead", kind: "number", unit: "mm", example: "3" },
  {
    key: "lead_shape",
    label: "leadShape",
    kind: "choice",
    options: [
      ["perpendicular", "perpendicular"],
      ["arc", "arc"],
    ],
  },
  { key: "reverse", label: "reverse", kind: "switch" },
  { key: "clearance", label: "clearance", kind: "number", unit: "mm", example: "0.02" },
  {
    key: "clearance_on",
    label: "clearanceOn",
    kind: "choice",
    options: [
      ["punch", "punch"],
      ["die", "die"],
    ],
  },
  { key: "start", label: "start", kind: "point", example: "20" },
  { key: "entry", label: "entry", kind: "point", example: "20" },
  { key: "order", label: "order", kind: "whole", example: "2" },
];

export class Fields {
  readonly #desk: Desk;
  readonly #fields = new Map<Key, Field>();

  constructor(desk: Desk, wrong: (message: string) => void) {
    this.#desk = desk;
    for (const plan of PLANS) {
      const take = (value: Value): void => this.#take({ [plan.key]: value } as Change);
      this.#fields.set(plan.key, new Field(plan, take, wrong, true));
    }
    get("fields").append(...[...this.#fields.values()].map(({ row }) => row));
    get("reset").addEventListener("click", () => desk.edit(reset(desk.edited, desk.scope, desk.contours)));
    desk.onChange(() => this.show());
  }

  #take(wanted: Change): void {
    const { edited, scope, contours } = this.#desk;
    this.#desk.edit(change(edited, scope, wanted, contours));
  }

  /** In the present language. */
  name(): void {
    for (const field of this.#fields.values()) field.name();
    this.show();
  }

  show(): void {
    const { scope, edited, state } = this.#desk;
    const wanted = own(edited, scope);
    get("h-values").textContent = this.#title();
    const { chosen, contours } = this.#desk;
    const isFew = typeof scope === "object" && "contours" in scope && chosen.length < MOST_CHOSEN;
    const count = isFew ? alikeTo(contours, chosen).length : 0;
    get("alike").hidden = count <= chosen.length;
    get("alike").textContent = w("alike", count);
    const button = get<HTMLButtonElement>("reset");
    button.textContent = w(typeof scope === "object" && "contours" in scope ? "resetToLayer" : "resetAll");
    button.disabled = !wanted.some((each) => PLANS.some(({ key }) => each[key] !== undefined));
    const isAll = scope === "all";
    const isOfContours = typeof scope === "object" && "contours" in scope;
    const isSingle = isOfContours && scope.contours.length === 1;
    for (const [key, field] of this.#fields) {
      field.row.hidden =
        !state || (SINGLE.has(key) && !isSingle) || (isAll && NOT_ALL.has(key)) || (isOfContours && NOT_SINGLE.has(key));
      if (key === "clearance_on") field.row.hidden ||= this.#values("clearance", wanted).every((each) => each === undefined);
      if (field.row.hidden) continue;
      const values = this.#values(key, wanted);
      const isMixed = values.some((value) => !same(value, values[0]));
      field.show(
        isMixed ? undefined : values[0],
        wanted.some((each) => each[key] !== undefined),
        isMixed,
      );
    }
  }

  #title(): string {
    const { scope, contours } = this.#desk;
    if (scope === "all") return w("allContours");
    if ("layer" in scope) return w("ofLayer", scope.layer);
    const [id, ...others] = scope.contours;
    const contour = id === undefined ? undefined : contours.get(id);
    return others.length || !contour ? w("ofMany", scope.contours.length) : titleOf(contour);
  }

  /** The values of a field that are in force: what is wanted itself first, so that it shows before the plan follows. */
  #values(key: Key, wanted: readonly Wanted[]): Value[] {
    const { scope, edited, contours } = this.#desk;
    if (scope === "all" || "layer" in scope) {
      const [here = {}] = wanted;
      return [(here[key] ?? edited.job.default?.[key] ?? (key === "offset" ? this.#offset() : USUAL[key])) as Value];
    }
    return scope.contours.map((id, at) => {
      const planned = this.#desk.planned(id);
      if (key === "cut") return isCut(edited, contours.get(id));
      const value = wanted[at]?.[key] ?? (planned && inForce(planned, key));
      return (key === "tabs" && Array.isArray(value) ? value.length : value) as Value;
    });
  }

  #offset(): number {
    const { wire, gap, offset } = this.#desk.edited.job.machine ?? {};
    if (typeof wire === "number") return wire / 2 + (typeof gap === "number" ? gap : 0);
    return typeof offset === "number" ? offset : 0;
  }
}

function inForce(planned: Planned, key: Key): unknown {
  if (key === "start") return planned.hole ?? undefined;
  if (key === "entry") return planned.entry ?? undefined;
  if (key === "order") return planned.number ?? undefined;
  return planned.values[key];
}
