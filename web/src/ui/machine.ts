/** The machine's values, and how the drawing is read. */
import { get } from "../dom.ts";
import type { Desk } from "./desk.ts";
import { type Edited, set } from "./edits.ts";
import { Field, type Plan, type Value } from "./inputs.ts";

type Part = "machine" | "read";

/** `usual`: the value in force where the job has none. */
interface Entry extends Plan {
  readonly part: Part;
  readonly usual?: Value;
}

const units = (...names: string[]): Plan["options"] => names.map((name) => [name, ""] as const);

const FIRST: readonly Entry[] = [
  { part: "machine", key: "wire", label: "wire", kind: "number", unit: "mm", example: "0.18" },
  { part: "machine", key: "gap", label: "gap", kind: "number", unit: "mm", example: "0.01" },
  { part: "machine", key: "feed", label: "feed", kind: "number", unit: "mm/min", example: "5", usual: 5 },
];
const MORE: readonly Entry[] = [
  { part: "machine", key: "offset", label: "machineOffset", kind: "number", unit: "mm", example: "0.1" },
  { part: "machine", key: "material", label: "material", kind: "text" },
  { part: "machine", key: "thickness", label: "thickness", kind: "text" },
  {
    part: "machine",
    key: "rom",
    label: "rom",
    kind: "choice",
    usual: "no-drift",
    options: [
      ["no-drift", "noDrift"],
      ["standard", "standard"],
    ],
  },
  { part: "machine", key: "ram", label: "ram", kind: "whole", usual: 8, example: "8" },
  {
    part: "machine",
    key: "small",
    label: "small",
    kind: "choice",
    usual: "refuse",
    options: [
      ["refuse", "openRefuse"],
      ["leave", "openLeave"],
    ],
  },
  {
    part: "machine",
    key: "into",
    label: "into",
    kind: "choice",
    usual: "refuse",
    options: [
      ["refuse", "openRefuse"],
      ["cut", "openCut"],
    ],
  },
  {
    part: "read",
    key: "units",
    label: "units",
    kind: "choice",
    usual: "",
    options: [["", "unitsFile"], ...(units("mm", "cm", "m", "inch", "foot", "mil", "um") ?? [])],
  },
  {
    part: "read",
    key: "open",
    label: "openEnds",
    kind: "choice",
    usual: "",
    options: [
      ["", "openUsual"],
      ["cut", "openCut"],
      ["leave", "openLeave"],
      ["refuse", "openRefuse"],
      ["all", "openAll"],
    ],
  },
  { part: "read", key: "tolerance", label: "tolerance", kind: "number", unit: "mm", usual: 0.005, example: "0.01" },
  { part: "read", key: "start_layer", label: "startLayer", kind: "text", usual: "START" },
];

export class MachineFields {
  readonly #desk: Desk;
  readonly #fields: [Entry, Field][];
  /** A gap that waits for its wire. */
  #gap: number | undefined;

  constructor(desk: Desk, wrong: (message: string) => void) {
    this.#desk = desk;
    this.#fields = [...FIRST, ...MORE].map((entry) => {
      const field = new Field(entry, (value) => this.#take(entry, value), wrong, MORE.includes(entry));
      get(FIRST.includes(entry) ? "machine" : "machine-more").append(field.row);
      return [entry, field];
    });
    desk.onChange((news) => {
      if (news.has("drawing")) this.#gap = undefined;
      this.show();
    });
  }

  #take({ part, key, usual }: Entry, value: Value): void {
    const wanted = value === usual ? undefined : value;
    const { edited } = this.#desk;
    let after = set(edited, part, key, wanted);
    if (key === "wire" && wanted !== undefined) {
      after = set(after, "machine", "offset", undefined);
      if (this.#gap !== undefined) after = set(after, "machine", "gap", this.#gap);
      this.#gap = undefined;
    }
    if (key === "wire" && wanted === undefined) after = set(after, "machine", "gap", undefined);
    if (key === "offset" && wanted !== undefined) after = withoutWire(after);
    if (key === "gap" && wanted !== undefined && edited.job.machine?.["wire"] === undefined) {
      // (a gap without a wire is no distance: it is taken with the wire)
      this.#gap = wanted as number;
      return;
    }
    this.#desk.edit(after);
  }

  name(): void {
    for (const [, field] of this.#fields) field.name();
    this.show();
  }

  show(): void {
    const { job } = this.#desk.edited;
    for (const [{ part, key, usual }, field] of this.#fields) {
      const value = (job[part]?.[key] ?? (key === "gap" ? this.#gap : undefined)) as Value;
      field.show(value ?? usual, value !== undefined);
    }
  }
}

const withoutWire = (edited: Edited): Edited => set(set(edited, "machine", "wire", undefined), "machine", "gap", undefined);
