/** Measuring on the drawing: a place, an arc's radius, the distance and the angle between two places. */
import type { XY } from "../tape.ts";
import { corners, isArc, micrometres, nearest, nearestEdge, type Shape } from "./geometry.ts";
import { w } from "./words.ts";

/** A place that was clicked, µm; the edge that it lies on, if it is on one, and whether within it. */
export interface Picked {
  readonly place: XY;
  readonly edge: readonly number[] | undefined;
  /** It is an end or a middle of an edge, or a centre: not any place on it. */
  readonly isPoint: boolean;
}

const text = (micrometres: number): string => (micrometres / 1000).toFixed(3);
const apart = ([x, y]: XY, [u, v]: XY): number => Math.hypot(x - u, y - v);
const centreOf = (edge: readonly number[]): XY => [edge[4] as number, edge[5] as number];
const radiusOf = (edge: readonly number[]): number => apart(centreOf(edge), [edge[0] as number, edge[1] as number]);

/** What is meant at a place: an end, a middle or a centre near it, else the nearest place of a contour, else itself; `reach`: µm.
 * `holes`: other places. */
export function pick(shapes: Iterable<Shape>, holes: readonly XY[], place: XY, reach: number): Picked {
  let point: XY | undefined;
  let on: Picked | undefined;
  let [bestPoint, best] = [reach, reach];
  const take = (candidate: XY): void => {
    const distance = apart(candidate, place);
    if (distance < bestPoint) [point, bestPoint] = [candidate, distance];
  };
  holes.forEach(take);
  for (const shape of shapes) {
    const [left, bottom, right, top] = shape.box;
    if (place[0] < left - reach || place[0] > right + reach || place[1] < bottom - reach || place[1] > top + reach) continue;
    for (const corner of corners(shape)) take(corner);
    for (const edge of shape.edges) if (isArc(edge)) take(centreOf(edge));
    const found = nearest(shape, place);
    if (found.distance < best) {
      best = found.distance;
      on = { place: found.place, edge: nearestEdge(shape, place), isPoint: false };
    }
  }
  // (half as near counts as on the edge itself: an arc's radius is asked for by a click anywhere on it)
  if (point && bestPoint < Math.max(reach / 2, best)) return { place: point, edge: on?.edge, isPoint: true };
  return on ?? { place, edge: undefined, isPoint: false };
}

/** What there is to say of one place, or of two. */
export function measured([one, two]: readonly Picked[]): string {
  if (!one) return w("measureBegin");
  if (!two) {
    const { edge, isPoint, place } = one;
    if (!edge || isPoint || !isArc(edge)) return w("measuredLine", ...place.map(text));
    const radius = radiusOf(edge);
    return w("measuredRadius", text(radius), text(2 * radius), ...centreOf(edge).map(text));
  }
  const [dx, dy] = [two.place[0] - one.place[0], two.place[1] - one.place[1]];
  const said = w("measured", text(Math.hypot(dx, dy)), text(Math.abs(dx)), text(Math.abs(dy)));
  const angle = between(one, two);
  return angle === undefined ? said : `${said}   ${w("measuredAngle", angle.toFixed(3))}`;
}

/** The angle between two lines that were clicked, degrees up to 90. */
function between(one: Picked, two: Picked): number | undefined {
  const [first, last] = [one, two].map(({ edge, isPoint }) => (edge && !isPoint && !isArc(edge) ? edge : undefined));
  if (!first || !last || first === last) return undefined;
  const way = ([x0, y0, x1, y1]: readonly number[]): number =>
    Math.atan2((y1 as number) - (y0 as number), (x1 as number) - (x0 as number));
  const turn = Math.abs(way(first) - way(last)) % Math.PI;
  return (Math.min(turn, Math.PI - turn) * 180) / Math.PI;
}

export const holesOf = (places: readonly (readonly [number, number])[]): XY[] => places.map(micrometres);
