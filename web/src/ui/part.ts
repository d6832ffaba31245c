/** The panel of where the part lies on the machine, and of its copies. */
import { get } from "../dom.ts";
import type { Desk } from "./desk.ts";
import { type Edited, set } from "./edits.ts";
import { Field, type Plan, type Value } from "./inputs.ts";
import type { Point } from "./types.ts";

type Part = "place" | "copies";

interface Entry extends Plan {
  readonly part: Part;
  readonly usual?: Value;
}

/** The choice of a place that is typed. */
const POINT = "point";
/** Between copies that nobody has given a step, mm. */
const BETWEEN = 5;

const ORIGIN: Entry = {
  part: "place",
  key: "origin",
  label: "origin",
  kind: "choice",
  usual: "",
  options: [
    ["", "originDrawing"],
    [POINT, "originPoint"],
    ["centre", "originCentre"],
    ["lower-left", "originLowerLeft"],
    ["lower-right", "originLowerRight"],
    ["upper-left", "originUpperLeft"],
    ["upper-right", "originUpperRight"],
  ],
};
const ORIGIN_AT: Entry = { part: "place", key: "origin-at", label: "originPoint", kind: "point", unit: "mm", example: "20" };
const ENTRIES: readonly Entry[] = [
  ORIGIN,
  ORIGIN_AT,
  { part: "place", key: "turn", label: "turn", kind: "number", unit: "°", example: "90", usual: 0 },
  {
    part: "place",
    key: "mirror",
    label: "mirror",
    kind: "choice",
    usual: "",
    options: [
      ["", "mirrorNot"],
      ["x", "mirrorX"],
      ["y", "mirrorY"],
    ],
  },
  { part: "place", key: "scale", label: "scale", kind: "number", unit: "×", example: "2", usual: 1 },
  { part: "copies", key: "columns", label: "columns", kind: "whole", example: "3", usual: 1 },
  { part: "copies", key: "rows", label: "rows", kind: "whole", example: "2", usual: 1 },
  { part: "copies", key: "step", label: "step", kind: "point", unit: "mm", example: "80" },
  { part: "copies", key: "around", label: "around", kind: "whole", example: "6", usual: 1 },
  { part: "copies", key: "about", label: "about", kind: "point", unit: "mm", example: "0" },
  { part: "copies", key: "every", label: "every", kind: "number", unit: "°", example: "60" },
];

export class PartFields {
  readonly #desk: Desk;
  readonly #fields: [Entry, Field][];

  constructor(desk: Desk, wrong: (message: string) => void) {
    this.#desk = desk;
    this.#fields = ENTRIES.map((entry) => {
      const field = new Field(entry, (value) => this.#take(entry, value), wrong, true);
      get("part-fields").append(field.row);
      return [entry, field];
    });
    desk.onChange(() => this.show());
  }

  #take({ part, key, usual }: Entry, value: Value): void {
    const { edited } = this.#desk;
    const wanted = value === usual ? undefined : value;
    if (key === "origin" && value === POINT) this.#desk.edit(set(edited, "place", "origin", [0, 0]));
    else if (key === "origin-at") this.#desk.edit(set(edited, "place", "origin", wanted));
    else if (part === "place") this.#desk.edit(set(edited, part, key, wanted));
    else this.#desk.edit(this.#copied(set(edited, part, key, wanted), key));
  }

  /** Copies with what they cannot be without: in rows a step, around a place this; not both. */
  #copied(edited: Edited, changed: string): Edited {
    const {
      columns = 1,
      rows = 1,
      step,
      around = 1,
      about,
    } = (edited.job.copies ?? {}) as Record<string, number> & {
      step?: Point;
      about?: Point;
    };
    const isInRows = columns > 1 || rows > 1;
    const without = (after: Edited, ...keys: string[]): Edited =>
      keys.reduce((each, key) => set(each, "copies", key, undefined), after);
    if (around > 1 && changed === "around") {
      const after = without(edited, "columns", "rows", "step");
      return about ? after : set(after, "copies", "about", [0, 0]);
    }
    if (!isInRows) return around > 1 ? edited : without(edited, "step", "about", "every");
    const after = without(edited, "around", "about", "every");
    const [x = 0, y = 0] = step ?? [];
    const [wide, high] = this.#size();
    return set(after, "copies", "step", [x || wide, y || high]);
  }

  /** Room for a copy beside the part, as it lies. */
  #size(): Point {
    const [width, height] = this.#desk.state?.size ?? [0, 0];
    const { turn = 0, scale = 1 } = (this.#desk.edited.job.place ?? {}) as Record<string, number>;
    const [c, s] = [Math.cos, Math.sin].map((each) => Math.abs(each((turn * Math.PI) / 180))) as [number, number];
    const room = (side: number): number => Math.ceil(scale * side - 1e-6) + BETWEEN;
    return [room(width * c + height * s), room(width * s + height * c)];
  }

  name(): void {
    for (const [, field] of this.#fields) field.name();
    this.show();
  }

  show(): void {
    const { job } = this.#desk.edited;
    const { columns = 1, rows = 1, around = 1 } = (job.copies ?? {}) as Record<string, number>;
    const isShown: Record<string, boolean> = {
      "origin-at": Array.isArray(job.place?.["origin"]),
      step: columns > 1 || rows > 1,
      about: around > 1,
      every: around > 1,
    };
    for (const [entry, field] of this.#fields) {
      const { part, key, usual } = entry;
      field.row.hidden = isShown[key] === false;
      const own = job[part]?.[key === "origin-at" ? "origin" : key] as Value;
      const value = key === "origin" && Array.isArray(own) ? POINT : own;
      field.show(value ?? usual, value !== undefined);
    }
  }
}
