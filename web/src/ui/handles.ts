/** Handles of the chosen contour: its start hole, its entry, its tab. */
import type { XY } from "../tape.ts";
import type { Desk } from "./desk.ts";
import { type Change, rounded } from "./edits.ts";
import { corners, lengthOfAll, micrometres, millimetres, nearest, placeAlong, wayToEntry, wrapped } from "./geometry.ts";

export type Grip = "start" | "entry" | "tab";

export interface Handle {
  readonly grip: Grip;
  readonly id: number;
  /** µm. */
  readonly place: XY;
}

/** A start hole that is moved by keys goes so far, mm; with Shift, so far. */
const STEPS = [1, 0.1];
/** A tab is changed by so much, mm. */
const TAB_STEPS = [0.5, 0.1];
/** No tab is dragged to be shorter, mm. */
const SHORTEST = 0.1;

/** Handles of the contour that is chosen alone. */
export function handlesOf(desk: Desk): Handle[] {
  const [id, ...others] = desk.chosen;
  const planned = id === undefined ? undefined : desk.planned(id);
  if (id === undefined || others.length || !planned?.cut) return [];
  const places: [Grip, readonly [number, number] | null][] = [
    ["tab", planned.values.tab ? planned.tab : null],
    ["start", planned.hole],
    ["entry", planned.entry],
  ];
  return places.flatMap(([grip, place]) => (place ? [{ grip, id, place: micrometres(place) }] : []));
}

/** The change made by dragging a handle to a place; `reach`: distance at which it snaps, µm. */
export function dragged(desk: Desk, { grip, id }: Handle, place: XY, reach: number): Change | undefined {
  const shape = desk.shapes.get(id);
  const planned = desk.planned(id);
  if (!shape || !planned) return undefined;
  const isNear = (other: XY): boolean => Math.hypot(other[0] - place[0], other[1] - place[1]) < reach;
  if (grip === "start") {
    const drilled = (desk.state?.starts ?? []).map(micrometres).find(isNear);
    return { start: rounded(millimetres(drilled ?? onGrid(place, reach))) };
  }
  const on = nearest(shape, [...corners(shape)].find(isNear) ?? place);
  if (grip === "entry") return { entry: rounded(millimetres(on.place)) };
  const { length } = wayToEntry(shape, on.along, micrometres(planned.entry ?? [0, 0]), planned.direction);
  return { tab: Math.max(SHORTEST, Math.round(length) / 1000) };
}

/** The change made by moving a handle with an arrow key; `dx`, `dy`: -1, 0 or 1. */
export function stepped(desk: Desk, { grip, id, place }: Handle, [dx, dy]: XY, isFine: boolean): Change | undefined {
  const shape = desk.shapes.get(id);
  const planned = desk.planned(id);
  if (!shape || !planned) return undefined;
  const step = STEPS[Number(isFine)] as number;
  const [x, y] = millimetres(place);
  if (grip === "start") return { start: rounded([x + dx * step, y + dy * step]) };
  if (grip === "tab") {
    const tab = (planned.values.tab ?? 0) + (dx + dy) * (TAB_STEPS[Number(isFine)] as number);
    return { tab: Math.max(0, Math.round(tab * 1000) / 1000) };
  }
  const whole = lengthOfAll(shape.edges);
  const along = nearest(shape, place).along + (dx + dy) * step * 1000;
  return { entry: rounded(millimetres(placeAlong(shape, wrapped(along, whole)).place)) };
}

/** A round place, as fine as a pointer can show it: a part of its reach. */
function onGrid([x, y]: XY, reach: number): XY {
  const step = Math.max(1, 10 ** Math.floor(Math.log10(Math.max(1, reach / 2))));
  return [Math.round(x / step) * step, Math.round(y / step) * step];
}
