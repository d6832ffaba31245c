/** The part on the machine: its zero and its copies on the drawing, and the tape brought back there. */
import type { Placed } from "../placed.ts";
import type { XY } from "../tape.ts";
import type { View } from "../view.ts";
import { type Box, boxOf } from "./geometry.ts";
import { arrowHead } from "./pen.ts";
import type { Lying, Matrix } from "./types.ts";

/** An arm of the cross at the machine's zero, pixels. */
const ARM = 46;
/** So many edges of copies are drawn: of more only the boxes. */
const MOST_EDGES = 40_000;

/** A place in µm where a matrix takes it. */
const moved = ([a, b, c, d, e, f]: Matrix, x: number, y: number): XY => [a * x + c * y + e * 1000, b * x + d * y + f * 1000];

/** An edge in µm where a matrix takes it. */
function movedEdge(by: Matrix, edge: readonly number[]): number[] {
  const [x0, y0, x1, y1, cx, cy, sweep] = edge as [number, number, number, number, number?, number?, number?];
  const ends = [...moved(by, x0, y0), ...moved(by, x1, y1)];
  if (cx === undefined || cy === undefined || sweep === undefined) return ends;
  const isMirror = by[0] * by[3] - by[1] * by[2] < 0;
  return [...ends, ...moved(by, cx, cy), isMirror ? -sweep : sweep];
}

/** The copies of some edges, or of the box around them. */
export function* copiesOf(lying: Lying | undefined, edges: readonly (readonly number[])[]): Generator<number[][]> {
  const copies = lying?.copies ?? [];
  if (!copies.length || !edges.length) return;
  const drawn = edges.length * copies.length > MOST_EDGES ? boxEdges(boxOf(edges)) : edges;
  for (const copy of copies) yield drawn.map((edge) => movedEdge(copy, edge));
}

function boxEdges([left, bottom, right, top]: Box): number[][] {
  return [
    [left, bottom, right, bottom],
    [right, bottom, right, top],
    [right, top, left, top],
    [left, top, left, bottom],
  ];
}

/** The box around a part and its copies. */
export function boxWithCopies(lying: Lying | undefined, box: Box): Box {
  return boxOf([
    ...boxEdges(box),
    ...(lying?.copies ?? []).flatMap((copy) => boxEdges(box).map((edge) => movedEdge(copy, edge))),
  ]);
}

/** The machine's zero, with the ways of x and y. */
export function drawZero(context: CanvasRenderingContext2D, view: View, lying: Lying, colour: string): void {
  if (!lying.zero) return;
  const [x, y] = view.toPixel([lying.zero[0] * 1000, lying.zero[1] * 1000]);
  context.strokeStyle = context.fillStyle = colour;
  context.lineWidth = 2;
  context.font = "600 12px system-ui, sans-serif";
  context.textAlign = "center";
  context.textBaseline = "middle";
  lying.axes.forEach(([u, v], at) => {
    const way = Math.atan2(v, u);
    const end: XY = [x + ARM * Math.cos(way), y - ARM * Math.sin(way)];
    const path = new Path2D();
    path.moveTo(x, y);
    path.lineTo(...end);
    context.stroke(path);
    const head = new Path2D();
    arrowHead(head, end, way);
    context.fill(head);
    context.fillText(at ? "Y" : "X", x + (ARM + 14) * Math.cos(way), y - (ARM + 14) * Math.sin(way));
  });
  context.textAlign = "start";
  context.beginPath();
  context.arc(x, y, 3.5, 0, 2 * Math.PI);
  context.fill();
}

/** The way from the machine to the drawing. */
export class WayBack {
  readonly #way: Matrix;

  /** `back`: as the server tells it, with a run; undefined: both are the same. */
  constructor(back: readonly number[] = [1, 0, 0, 1, 0, 0, 0, 0]) {
    const [a, b, c, d, x, y, u, v] = back as [number, number, number, number, number, number, number, number];
    this.#way = [a, c, b, d, u - a * x - b * y, v - c * x - d * y];
  }

  place(place: XY): XY {
    return moved(this.#way, ...place);
  }

  block(placed: Placed): Placed {
    const isMirror = this.#way[0] * this.#way[3] - this.#way[1] * this.#way[2] < 0;
    const [start, end, centre] = [placed.start, placed.end, placed.centre].map((each) => this.place(each)) as [XY, XY, XY];
    return { ...placed, start, end, centre, sweep: isMirror ? -placed.sweep : placed.sweep };
  }
}
