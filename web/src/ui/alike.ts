/** Contours that look alike: of one kind, one size and as many edges. */
import type { Contour } from "./types.ts";

/** Sizes that differ by less are the same, parts of a mm. */
const SAME = 1000;

const keyOf = ({ kind, size, closed, edges }: Contour): string =>
  JSON.stringify([kind, closed, edges.length, ...size.map((side) => Math.round(side * SAME))]);

/** Contours in groups that are alike, each where its first one is. */
export function groups(contours: Iterable<Contour>): Contour[][] {
  const known = new Map<string, Contour[]>();
  for (const contour of contours) {
    const key = keyOf(contour);
    const group = known.get(key);
    if (group) group.push(contour);
    else known.set(key, [contour]);
  }
  return [...known.values()];
}

/** All that are alike to one of these, by their numbers. */
export function alikeTo(contours: ReadonlyMap<number, Contour>, ids: readonly number[]): number[] {
  const keys = new Set(ids.flatMap((id) => contours.get(id) ?? []).map(keyOf));
  return [...contours.values()].filter((contour) => keys.has(keyOf(contour))).map(({ id }) => id);
}
