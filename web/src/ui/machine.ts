/** The machine's values, and how the drawing is read. */
import { get } from "../dom.ts";
import type { Desk } from "./desk.ts";
import { type Edited, set } from "./edits.ts";
import { Field, type Plan, type Value } from "./inputs.ts";
import { find, type Word, w } from "./words.ts";

type Part = "machine" | "read" | "price";

/** `usual`: the value in force where the job has none. */
interface Entry extends Plan {
  readonly part: Part;
  readonly usual?: Value;
}

/** Units by their names; those that are no signs have words. */
const UNIT_WORDS: Record<string, Word> = { inch: "inch", foot: "foot" };
const units = (...names: string[]): Plan["options"] => names.map((name) => [name, UNIT_WORDS[name] ?? ""] as const);

const FIRST: readonly Entry[] = [
  { part: "machine", key: "wire", label: "wire", kind: "number", unit: "mm", example: "0.18" },
  { part: "machine", key: "gap", label: "gap", kind: "number", unit: "mm", example: "0.01" },
  { part: "machine", key: "feed", label: "feed", kind: "number", unit: "mm/min", example: "5", usual: 5 },
  { part: "machine", key: "thickness", label: "thickness", kind: "number", unit: "mm", example: "40" },
];
/** Beside the drawing's size. */
const UNITS: Entry = {
  part: "read",
  key: "units",
  label: "units",
  kind: "choice",
  usual: "",
  options: [["", "unitsFile"], ...(units("mm", "cm", "m", "inch", "foot", "mil", "um") ?? [])],
};
const MORE: readonly Entry[] = [
  { part: "machine", key: "offset", label: "machineOffset", kind: "number", unit: "mm", example: "0.1" },
  { part: "machine", key: "rates", label: "rates", kind: "list", example: "80, 120" },
  { part: "price", key: "per_area", label: "perArea", kind: "list", example: "0.01, 0.004" },
  { part: "price", key: "per_hole", label: "perHole", kind: "number", example: "5", usual: 0 },
  { part: "price", key: "per_pass", label: "perPass", kind: "number", example: "2", usual: 0 },
  { part: "price", key: "currency", label: "currency", kind: "text" },
  { part: "machine", key: "material", label: "material", kind: "text" },
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
    this.#fields = [...FIRST, UNITS, ...MORE].map((entry) => {
      const field = new Field(entry, (value) => this.#take(entry, value), wrong, MORE.includes(entry));
      if (entry === UNITS) get("size").after(field.row);
      else get(FIRST.includes(entry) ? "machine" : "machine-more").append(field.row);
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

  /** The file's own units, in place of the word for them. */
  #nameUnits(): void {
    const option = document.querySelector("#field-units option");
    if (option) option.textContent = w("unitsFile", find(this.#desk.state?.units ?? "") ?? this.#desk.state?.units ?? "");
  }

  show(): void {
    const { job } = this.#desk.edited;
    if (job.read?.["units"] === undefined) this.#nameUnits();
    for (const [entry, field] of this.#fields) {
      const { part, key, usual } = entry;
      if (entry === UNITS) field.row.hidden = !this.#desk.state;
      const value = (job[part]?.[key] ?? (key === "gap" ? this.#gap : undefined)) as Value;
      field.show(value ?? usual, value !== undefined);
    }
  }
}

const withoutWire = (edited: Edited): Edited => set(set(edited, "machine", "wire", undefined), "machine", "gap", undefined);
