/** Changes of a job: each gives another job. Contours are known by their numbers in the drawing as it is now. */
import type { Chosen, Contour, Job, Match, Point, Repair, Tables, Values, Wanted } from "./types.ts";

/** A job, and the contour that each of its `contour` entries is about; null: it is lost. */
export interface Edited {
  readonly job: Job;
  readonly ids: readonly (number | null)[];
}

/** The scope of a setting: contours, a layer, or everything. */
export type Scope = { contours: readonly number[] } | { layer: string } | "all";

/** undefined: inherited again. */
export type Change = { [K in keyof Wanted]: Wanted[K] | undefined };

const PLACE = new Set(["layer", "kind", "at", "size"]);

export function edited(job: Job, matches: readonly Match[]): Edited {
  const ids: (number | null)[] = (job.contour ?? []).map(() => null);
  for (const { chosen, id } of matches) ids[chosen] = id;
  return { job, ids };
}

/** The same job for a drawing that was read anew: entries are about the contours that lie where they say, or that `fresh` has
 * found for them. */
export function moved({ job }: Edited, fresh: Edited, contours: readonly Contour[]): Edited {
  const key = ({ layer, kind, at, size }: Chosen | Contour): string => JSON.stringify([layer, kind, at, size]);
  const numbers = new Map<string, number | null>(contours.map((contour) => [key(contour), contour.id]));
  fresh.job.contour?.forEach((chosen, index) => {
    numbers.set(key(chosen), fresh.ids[index] ?? null);
  });
  return { job, ids: (job.contour ?? []).map((chosen) => numbers.get(key(chosen)) ?? null) };
}

/** The scope's own settings, without inherited ones. */
export function own(edited: Edited, scope: Scope): Wanted[] {
  const { job } = edited;
  if (scope === "all") return [job.default ?? {}];
  if ("layer" in scope) return [(job.layer ?? []).find(({ name }) => name === scope.layer) ?? {}];
  return scope.contours.map((id) => entryOf(edited, id) ?? {});
}

export function change(before: Edited, scope: Scope, wanted: Change, contours: ReadonlyMap<number, Contour>): Edited {
  const { job } = before;
  if (scope === "all") return { ...before, job: { ...job, default: merged(job.default ?? {}, wanted) } };
  if ("layer" in scope) {
    const layers = job.layer ?? [];
    const found = layers.find(({ name }) => name === scope.layer) ?? { name: scope.layer };
    const after = merged(found, wanted);
    const others = layers.filter(({ name }) => name !== scope.layer);
    return { ...before, job: { ...job, layer: Object.keys(after).length > 1 ? [...others, after] : others } };
  }
  return ofContours(before, scope.contours, wanted, contours);
}

function ofContours(before: Edited, ids: readonly number[], wanted: Change, contours: ReadonlyMap<number, Contour>): Edited {
  const entries = [...(before.job.contour ?? [])];
  const numbers = [...before.ids];
  for (const id of ids) {
    const contour = contours.get(id);
    if (!contour) continue;
    const { layer, kind, at, size } = contour;
    const index = indexOf(before, id) ?? entries.length;
    entries[index] = { ...merged(entries[index] ?? {}, wanted), layer, kind, at, size };
    numbers[index] = id;
  }
  const isKept = entries.map((entry, index) => numbers[index] === null || Object.keys(entry).some((key) => !PLACE.has(key)));
  return {
    job: { ...before.job, contour: entries.filter((_, index) => isKept[index]) },
    ids: numbers.filter((_, index) => isKept[index]),
  };
}

const INDICES = new WeakMap<readonly (number | null)[], Map<number, number>>();

/** The entry of a contour in the job. */
function indexOf({ ids }: Edited, id: number): number | undefined {
  let indices = INDICES.get(ids);
  if (!indices) {
    indices = new Map(ids.flatMap((each, index) => (each === null ? [] : [[each, index]])));
    INDICES.set(ids, indices);
  }
  return indices.get(id);
}

const entryOf = (edited: Edited, id: number): Chosen | undefined => edited.job.contour?.[indexOf(edited, id) ?? -1];

function merged<T extends Wanted>(before: T, wanted: Change): T {
  return Object.fromEntries(Object.entries({ ...before, ...wanted }).filter(([, value]) => value !== undefined)) as T;
}

/** All that was wanted of it is inherited again. */
export function reset(before: Edited, scope: Scope, contours: ReadonlyMap<number, Contour>): Edited {
  const keys = own(before, scope).flatMap((wanted) => Object.keys(wanted)) as (keyof Wanted | "name" | "at")[];
  const none = Object.fromEntries(keys.filter((key) => key !== "name" && !PLACE.has(key)).map((key) => [key, undefined]));
  return change(before, scope, none as Change, contours);
}

/** Drops the settings of a contour that is not in the drawing any more. */
export function forget({ job, ids }: Edited, index: number): Edited {
  const without = <T>(list: readonly T[]): T[] => list.filter((_, each) => each !== index);
  return { job: { ...job, contour: without(job.contour ?? []) }, ids: without(ids) };
}

/** A value of the machine, of prices, of how the drawing is read, or of where it lies; undefined: the usual one. */
export function set(
  before: Edited,
  part: "machine" | "read" | "price" | "place" | "copies",
  key: string,
  value: unknown,
): Edited {
  const { [key]: _, ...others } = before.job[part] ?? {};
  return { ...before, job: { ...before.job, [part]: value === undefined ? others : { ...others, [key]: value } } };
}

/** Tables take the place of all that the job has of their keys. */
export function withTables(before: Edited, keys: Readonly<Record<string, readonly string[]>>, tables: Tables): Edited {
  const taken = Object.entries(keys).map(([table, own]) => {
    const found = (before.job[table as keyof Job] ?? {}) as Values;
    const others = Object.entries(found).filter(([key]) => !own.includes(key));
    return [table, { ...Object.fromEntries(others), ...tables[table] }] as const;
  });
  return { ...before, job: { ...before.job, ...Object.fromEntries(taken) } };
}

/** The job's lists of repairs. */
const REPAIRS = { bridge: "bridges", corner: "corners", stray: "strays" } as const;

/** The repairs that were asked for. */
const repairsOf = ({ job }: Edited, kind: Repair["kind"]): readonly (readonly number[])[] =>
  (job.read?.[REPAIRS[kind]] ?? []) as readonly (readonly number[])[];

export const isRepaired = (edited: Edited, { kind, asked }: Repair): boolean =>
  repairsOf(edited, kind).some((other) => String(other) === String(asked));

export const countRepairs = (edited: Edited): number =>
  (Object.keys(REPAIRS) as Repair["kind"][]).reduce((sum, kind) => sum + repairsOf(edited, kind).length, 0);

/** Repairs are asked for, beside those that there are. */
export const repaired = (before: Edited, repairs: readonly Repair[]): Edited =>
  repairs
    .filter((repair) => !isRepaired(before, repair))
    .reduce((edited, { kind, asked }) => set(edited, "read", REPAIRS[kind], [...repairsOf(edited, kind), asked]), before);

export const withoutRepairs = (before: Edited): Edited =>
  Object.values(REPAIRS).reduce((edited, key) => set(edited, "read", key, undefined), before);

/** Places are whole µm. */
export const rounded = ([x, y]: Point): Point => [Math.round(x * 1000) / 1000, Math.round(y * 1000) / 1000];

/** Tell if a contour is to be cut: itself, the first of its layers in the job, and everything are asked, in this order. */
export function isCut(edited: Edited, contour: Contour | undefined): boolean {
  if (!contour) return false;
  const { job } = edited;
  const chosen = entryOf(edited, contour.id);
  const on = contour.layers.map((name) => name.toLowerCase());
  const layer = job.layer?.find(({ name, cut }) => cut !== undefined && on.includes(name.toLowerCase()));
  return chosen?.cut ?? layer?.cut ?? job.default?.cut ?? true;
}
