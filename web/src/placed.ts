/** A tape laid out on the drawing: absolute lines and arcs, in µm. */
import {
  type Block,
  closedMovesSteps,
  finish,
  type Item,
  isFullCircle,
  moveOf,
  STEP,
  startOf,
  sweepOf,
  type XY,
} from "./tape.ts";

/** A block in its place. `sweep` is in radians, counter-clockwise positive, 0 for a line; `line` the program line that made it
 * (0: unknown), `number` its number on the tape from 1. */
export interface Placed {
  readonly block: Block;
  readonly number: number;
  readonly line: number;
  readonly start: XY;
  readonly end: XY;
  readonly centre: XY;
  readonly radius: number;
  /** Angle of the start about the centre. */
  readonly first: number;
  readonly sweep: number;
  readonly length: number;
  role: Role;
}

/** The purpose of a block: to cut, the way from the start hole or back to it, or positioning from hole to hole. It is known when
 * the route is at its end. */
export type Role = "cut" | "in" | "back" | "move";

/** The blocks between two stops: indices, `last` is behind the last one. */
export interface Route {
  readonly first: number;
  readonly last: number;
  readonly isMove: boolean;
}

/** A whole tape in its places. */
export interface Layout {
  readonly blocks: Placed[];
  readonly routes: Route[];
  /** The places at which the controller stops, and the number of the block before each. */
  readonly stops: { at: XY; after: number }[];
  /** The places at which a wire is threaded. */
  readonly holes: XY[];
}

/** A block from `start` to `end`. The sweep is the block's, corrected by what the ends lie away from where the block alone has
 * them. */
function placeBlock(block: Block, start: XY, end: XY, number: number, line: number): Placed {
  const common = { block, number, line, start, end, role: "cut" as Role };
  if (!block.sense) {
    return { ...common, centre: start, radius: 0, first: 0, sweep: 0, length: Math.hypot(end[0] - start[0], end[1] - start[1]) };
  }
  const [x, y] = startOf(block);
  const centre: XY = [start[0] - x, start[1] - y];
  const first = Math.atan2(y, x);
  let sweep = sweepOf(block);
  if (!isFullCircle(block)) {
    const last = Math.atan2(end[1] - centre[1], end[0] - centre[0]);
    const off = last - first - sweep + Math.PI;
    sweep += off - Math.floor(off / (2 * Math.PI)) * 2 * Math.PI - Math.PI;
  }
  const radius = Math.hypot(x, y);
  return { ...common, centre, radius, first, sweep, length: radius * Math.abs(sweep) };
}

export const isLine = (p: Placed): boolean => p.radius === 0;

/** The place at `part` (0 to 1) of the block. */
export function placeAt(p: Placed, part: number): XY {
  if (isLine(p)) {
    return [p.start[0] + part * (p.end[0] - p.start[0]), p.start[1] + part * (p.end[1] - p.start[1])];
  }
  const angle = p.first + part * p.sweep;
  return [p.centre[0] + p.radius * Math.cos(angle), p.centre[1] + p.radius * Math.sin(angle)];
}

/** Direction of travel at `part`, radians. */
export function directionAt(p: Placed, part: number): number {
  if (isLine(p)) return Math.atan2(p.end[1] - p.start[1], p.end[0] - p.start[0]);
  return p.first + part * p.sweep + (Math.sign(p.sweep) * Math.PI) / 2;
}

/** Distance of a place from the block, µm. */
export function distanceFrom(p: Placed, [x, y]: XY): number {
  if (isLine(p)) {
    const [dx, dy] = [p.end[0] - p.start[0], p.end[1] - p.start[1]];
    const square = dx * dx + dy * dy;
    const part = square ? Math.min(1, Math.max(0, ((x - p.start[0]) * dx + (y - p.start[1]) * dy) / square)) : 0;
    return Math.hypot(x - p.start[0] - part * dx, y - p.start[1] - part * dy);
  }
  const angle = Math.atan2(y - p.centre[1], x - p.centre[0]);
  const ahead = p.sweep > 0 ? angle - p.first : p.first - angle;
  const turn = ahead - Math.floor(ahead / (2 * Math.PI)) * 2 * Math.PI;
  if (turn <= Math.abs(p.sweep)) return Math.abs(Math.hypot(x - p.centre[0], y - p.centre[1]) - p.radius);
  return Math.min(Math.hypot(x - p.start[0], y - p.start[1]), Math.hypot(x - p.end[0], y - p.end[1]));
}

/** xmin, ymin, xmax, ymax of a block, bulges of arcs included. */
export function boxOf(p: Placed): [number, number, number, number] {
  let [left, right] = p.start[0] < p.end[0] ? [p.start[0], p.end[0]] : [p.end[0], p.start[0]];
  let [bottom, top] = p.start[1] < p.end[1] ? [p.start[1], p.end[1]] : [p.end[1], p.start[1]];
  if (!isLine(p)) {
    const [low, high] = p.sweep > 0 ? [p.first, p.first + p.sweep] : [p.first + p.sweep, p.first];
    for (let quarter = Math.ceil(low / (Math.PI / 2)); quarter * (Math.PI / 2) <= high; quarter++) {
      const side = ((quarter % 4) + 4) % 4;
      if (side === 0) right = Math.max(right, p.centre[0] + p.radius);
      else if (side === 1) top = Math.max(top, p.centre[1] + p.radius);
      else if (side === 2) left = Math.min(left, p.centre[0] - p.radius);
      else bottom = Math.min(bottom, p.centre[1] - p.radius);
    }
  }
  return [left, bottom, right, top];
}

/** Builds a layout block by block, as the machine punches. */
export class Placer {
  readonly layout: Layout = nothing();
  #at: XY = [0, 0];
  #isUnsettled = false;

  /** `end`: where the firmware's wire stands behind the block, when that is known. */
  add(item: Item, line: number, end?: XY): void {
    const { blocks, stops } = this.layout;
    if (item === "D") {
      if (!blocks.length && end) this.#at = end;
      stops.push({ at: this.#at, after: blocks.length });
      this.#isUnsettled = true;
      return;
    }
    const move = moveOf(item);
    let start = this.#at;
    if (end && !blocks.length && !stops.length) {
      // (a drawing's own half micrometres: the start is whole)
      start = [end[0] - move[0], end[1] - move[1]];
      this.#at = start;
    }
    const programmed: XY = [start[0] + move[0], start[1] + move[1]];
    // An arc's end may be a µm beside what the block alone tells: then the firmware knows better.
    const known = end && Math.abs(end[0] - programmed[0]) <= 2 && Math.abs(end[1] - programmed[1]) <= 2;
    this.#at = known ? end : programmed;
    blocks.push(placeBlock(item, start, this.#at, blocks.length + 1, line));
  }

  /** Finds what each block is for, when a route has ended since this was done last: once for many stops. */
  settle(): void {
    if (this.#isUnsettled) survey(this.layout);
    this.#isUnsettled = false;
  }

  /** The tape ends: the last route's way back is known. */
  end(): void {
    this.#isUnsettled = true;
    this.settle();
  }
}

export const nothing = (): Layout => ({ blocks: [], routes: [], stops: [], holes: [] });

/** Finds the routes of a layout, its start holes, and what each block is for.
 *
 * A re-positioning is a stop, at most one straight move and another stop, so on a tape of such every second stretch is one, and
 * what stands between two of them is cut, a single line too. On any other tape a single line between two stops is one. */
function survey(layout: Layout): void {
  const { blocks, stops } = layout;
  const ends = [...stops.map(({ after }) => after), blocks.length];
  const stretches = ends.map((last, at) => ({ first: ends[at - 1] ?? 0, last }));
  const isStraight = stretches.map(
    ({ first, last }) => last === first || (last === first + 1 && isLine(blocks[first] as Placed)),
  );
  const isInside = (at: number): boolean => at > 0 && at < stretches.length - 1;
  const alternate = isStraight.every((straight, at) => straight || at % 2 === 0 || !isInside(at));
  layout.routes.length = layout.holes.length = 0;
  stretches.forEach(({ first, last }, at) => {
    const isMove = isInside(at) && (alternate ? at % 2 === 1 : (isStraight[at] as boolean));
    if (first === last) return;
    layout.routes.push({ first, last, isMove });
    if (!isMove) layout.holes.push((blocks[first] as Placed).start);
    const route = blocks.slice(first, last);
    for (const placed of route) placed.role = isMove ? "move" : "cut";
    if (!isMove) markLeads(route);
  });
}

/** A way in is a line, the way back the line that goes back along it later on: the path between them is closed. There may be
 * several, one after the other, when a contour is cut more than once. */
function markLeads(route: readonly Placed[]): void {
  let at = 0;
  for (let back = wayBack(route, at); back !== undefined; back = wayBack(route, at)) {
    (route[at] as Placed).role = "in";
    (route[back] as Placed).role = "back";
    at = back + 1;
  }
}

/** The line that goes back along the line `first`. */
function wayBack(route: readonly Placed[], first: number): number | undefined {
  const lead = route[first];
  if (!lead || !isLine(lead)) return undefined;
  const [dx, dy] = moveOf(lead.block);
  let arcs = 0;
  for (let at = first + 1; at < route.length; at++) {
    const placed = route[at] as Placed;
    if (!isLine(placed)) {
      arcs++;
      continue;
    }
    const [ex, ey] = moveOf(placed.block);
    const apart = Math.max(Math.abs(placed.start[0] - lead.end[0]), Math.abs(placed.start[1] - lead.end[1]));
    // Each arc between them may have ended beside its place; two lines alone enclose nothing.
    if (at > first + 1 && Math.max(Math.abs(dx + ex), Math.abs(dy + ey)) <= 1 && apart <= 2 * (arcs + 1)) return at;
  }
  return undefined;
}

/** Lays out a tape whose places are not known, from `start`. */
export const layOut = (items: readonly Item[], start: XY = [0, 0]): Placer => finish(layOutSteps(items, start));

/** The same in steps of some hundred blocks. */
export function* layOutSteps(items: readonly Item[], start: XY = [0, 0]): Generator<undefined, Placer> {
  const placer = new Placer();
  const ends = yield* placesOf(items, start);
  for (const [at, item] of items.entries()) {
    if (at % STEP === STEP - 1) yield;
    placer.add(item, 0, ends[at]);
  }
  yield;
  placer.end();
  return placer;
}

/** The end of each item; of a stop, its place. */
function* placesOf(items: readonly Item[], start: XY): Generator<undefined, XY[]> {
  const found: XY[] = [];
  let at = start;
  let route: Block[] = [];
  function* flush(): Generator<undefined, void> {
    for (const [dx, dy] of yield* closedMovesSteps(route)) {
      at = [at[0] + dx, at[1] + dy];
      found.push(at);
    }
    route = [];
  }
  for (const [index, item] of items.entries()) {
    if (index % STEP === STEP - 1) yield;
    if (item === "D") {
      yield* flush();
      found.push(at);
    } else {
      route.push(item);
    }
  }
  yield* flush();
  return found;
}

/** xmin, ymin, xmax, ymax of all blocks; undefined where there is none. */
export function extentOf(blocks: readonly Placed[]): [number, number, number, number] | undefined {
  let found: [number, number, number, number] | undefined;
  for (const placed of blocks) {
    const [a, b, c, d] = boxOf(placed);
    found = found ? [Math.min(found[0], a), Math.min(found[1], b), Math.max(found[2], c), Math.max(found[3], d)] : [a, b, c, d];
  }
  return found;
}
