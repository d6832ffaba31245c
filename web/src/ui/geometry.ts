/** Contours of a drawing on the canvas: lines, arcs and curves in µm. */
import type { XY } from "../tape.ts";
import type { Contour, Edge, Point } from "./types.ts";

export type Box = readonly [number, number, number, number];

/** A contour with its edges in µm. */
export interface Shape {
  readonly contour: Contour;
  readonly edges: readonly (readonly number[])[];
  readonly box: Box;
}

/** A place on a contour: how far from the given one, and how far along from the contour's first point. */
export interface OnContour {
  readonly place: XY;
  readonly distance: number;
  readonly along: number;
  /** Direction of the contour there, radians. */
  readonly way: number;
}

/** An arc is drawn as lines that leave it by at most so much, pixels. */
const TOLERANCE = 0.15;

export const micrometres = ([x, y]: Point): XY => [x * 1000, y * 1000];
export const millimetres = ([x, y]: XY): Point => [x / 1000, y / 1000];

/** A line's 4 numbers or an arc's 7, in µm; a curve as the lines that it is sent as. */
function* scaled(edge: Edge): Generator<readonly number[]> {
  const isCurve = edge[0] === "c";
  const numbers = (isCurve ? edge.slice(1) : edge) as readonly number[];
  const lengths = numbers.map((value, at) => (isCurve || at < 6 ? value * 1000 : value));
  if (!isCurve) yield lengths;
  else for (let at = 0; at + 3 < lengths.length; at += 2) yield lengths.slice(at, at + 4);
}

export const edgesOf = (edges: readonly Edge[]): readonly (readonly number[])[] => edges.flatMap((edge) => [...scaled(edge)]);

export function shapeOf(contour: Contour): Shape {
  const edges = edgesOf(contour.edges);
  return { contour, edges, box: boxOf(edges) };
}

export const isArc = (edge: readonly number[]): boolean => edge.length > 4;

export const startOf = (edge: readonly number[]): XY => [edge[0] as number, edge[1] as number];

/** Goes along an edge from behind its start to its end, in steps that look round at this scale. */
export function trace(edge: readonly number[], scale: number, to: (x: number, y: number) => void): void {
  const [x0, y0, x1, y1, cx, cy, sweep] = edge as [number, number, number, number, number, number, number];
  if (isArc(edge)) {
    const radius = Math.hypot(x0 - cx, y0 - cy);
    const step = 2 * Math.acos(Math.max(0, 1 - TOLERANCE / Math.max(radius * scale, TOLERANCE)));
    const parts = Math.min(20_000, Math.ceil(Math.abs(sweep) / Math.max(step, 1e-6)));
    const first = Math.atan2(y0 - cy, x0 - cx);
    for (let part = 1; part < parts; part++) {
      const angle = first + (sweep * part) / parts;
      to(cx + radius * Math.cos(angle), cy + radius * Math.sin(angle));
    }
  }
  to(x1, y1);
}

const lengthOf = (piece: readonly number[]): number => {
  const [x0, y0, x1, y1, cx, cy, sweep] = piece as [number, number, number, number, number, number, number];
  return isArc(piece) ? Math.hypot(x0 - cx, y0 - cy) * Math.abs(sweep) : Math.hypot(x1 - x0, y1 - y0);
};

export function lengthOfAll(edges: readonly (readonly number[])[]): number {
  let sum = 0;
  for (const piece of edges) sum += lengthOf(piece);
  return sum;
}

/** The place of a contour that is nearest. */
export function nearest({ edges }: Pick<Shape, "edges">, place: XY): OnContour {
  let best: OnContour = { place, distance: Number.POSITIVE_INFINITY, along: 0, way: 0 };
  let before = 0;
  for (const piece of edges) {
    const length = lengthOf(piece);
    const candidate = atPart(piece, nearestPart(piece, place), before, length);
    const distance = Math.hypot(candidate.place[0] - place[0], candidate.place[1] - place[1]);
    if (distance < best.distance) best = { ...candidate, distance };
    before += length;
  }
  return best;
}

/** The edge of a contour that is nearest. */
export function nearestEdge({ edges }: Pick<Shape, "edges">, place: XY): readonly number[] | undefined {
  let best = Number.POSITIVE_INFINITY;
  let found: readonly number[] | undefined;
  for (const edge of edges) {
    const { distance } = nearest({ edges: [edge] }, place);
    if (distance < best) [best, found] = [distance, edge];
  }
  return found;
}

/** The place so far along a contour. */
export function placeAlong({ edges }: Pick<Shape, "edges">, along: number): OnContour {
  let before = 0;
  let last: OnContour | undefined;
  for (const piece of edges) {
    const length = lengthOf(piece);
    last = { ...atPart(piece, length ? Math.min(1, (along - before) / length) : 0, before, length), distance: 0 };
    if (along <= before + length) break;
    before += length;
  }
  return last ?? { place: [0, 0], distance: 0, along: 0, way: 0 };
}

function nearestPart(piece: readonly number[], [x, y]: XY): number {
  const [x0, y0, x1, y1, cx, cy, sweep] = piece as [number, number, number, number, number, number, number];
  if (!isArc(piece)) {
    const [dx, dy] = [x1 - x0, y1 - y0];
    const square = dx * dx + dy * dy;
    return square ? Math.min(1, Math.max(0, ((x - x0) * dx + (y - y0) * dy) / square)) : 0;
  }
  const ahead = (Math.atan2(y - cy, x - cx) - Math.atan2(y0 - cy, x0 - cx)) * Math.sign(sweep);
  const turn = ahead - Math.floor(ahead / (2 * Math.PI)) * 2 * Math.PI;
  const whole = Math.abs(sweep);
  if (turn <= whole) return turn / whole;
  return turn - whole < 2 * Math.PI - turn ? 1 : 0;
}

function atPart(piece: readonly number[], part: number, before: number, length: number): Omit<OnContour, "distance"> {
  const [x0, y0, x1, y1, cx, cy, sweep] = piece as [number, number, number, number, number, number, number];
  const along = before + part * length;
  if (!isArc(piece)) {
    return { place: [x0 + part * (x1 - x0), y0 + part * (y1 - y0)], along, way: Math.atan2(y1 - y0, x1 - x0) };
  }
  const angle = Math.atan2(y0 - cy, x0 - cx) + part * sweep;
  const radius = Math.hypot(x0 - cx, y0 - cy);
  return {
    place: [cx + radius * Math.cos(angle), cy + radius * Math.sin(angle)],
    along,
    way: angle + (Math.sign(sweep) * Math.PI) / 2,
  };
}

/** xmin, ymin, xmax, ymax of edges, to a few µm of their arcs' bulges. */
export function boxOf(edges: readonly (readonly number[])[]): Box {
  let [left, bottom, right, top] = [Infinity, Infinity, -Infinity, -Infinity];
  const take = (x: number, y: number): void => {
    left = Math.min(left, x);
    bottom = Math.min(bottom, y);
    right = Math.max(right, x);
    top = Math.max(top, y);
  };
  for (const edge of edges) {
    take(...startOf(edge));
    trace(edge, 0.05, take);
  }
  return [left, bottom, right, top];
}

/** Places on a contour that a dragged one snaps to: ends and middles of its edges. */
export function* corners({ edges }: Shape): Generator<XY> {
  for (const edge of edges) {
    yield startOf(edge);
    yield atPart(edge, 0.5, 0, 0).place;
  }
}

/** A length along a closed contour within its own, `whole`. */
export const wrapped = (along: number, whole: number): number => ((along % whole) + whole) % whole;

/** The wire's way on a closed contour from a place to the entry, µm, and whether that is the contour's own direction. */
export function wayToEntry(
  shape: Shape,
  along: number,
  entry: XY,
  direction: number | null,
): { length: number; isWith: boolean } {
  const at = nearest(shape, entry);
  const isWith = goesWith(at.way, direction ?? at.way);
  return { length: wrapped(isWith ? at.along - along : along - at.along, lengthOfAll(shape.edges)), isWith };
}

/** Tell if a direction of travel is the contour's own, not the opposite. */
export const goesWith = (way: number, direction: number): boolean => Math.cos(way - direction) >= 0;

/** Tell if a contour runs through a box, or lies in it. */
export function touches({ edges, box }: Shape, [left, bottom, right, top]: Box, scale: number): boolean {
  if (box[0] > right || box[2] < left || box[1] > top || box[3] < bottom) return false;
  for (const edge of edges) {
    let [x0, y0] = startOf(edge);
    let isIn = false;
    trace(edge, scale, (x, y) => {
      isIn ||= crosses(x0, y0, x - x0, y - y0, [left, bottom, right, top]);
      [x0, y0] = [x, y];
    });
    if (isIn) return true;
  }
  return false;
}

/** A line from a place has a part in a box. (Liang and Barsky, 1984.) */
function crosses(x: number, y: number, dx: number, dy: number, [left, bottom, right, top]: Box): boolean {
  let [from, to] = [0, 1];
  for (const [way, room] of [
    [-dx, x - left],
    [dx, right - x],
    [-dy, y - bottom],
    [dy, top - y],
  ] as [number, number][]) {
    if (!way && room < 0) return false;
    if (way < 0) from = Math.max(from, room / way);
    else if (way > 0) to = Math.min(to, room / way);
  }
  return from <= to;
}
