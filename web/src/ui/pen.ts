/** Edges in µm as paths in pixels. */
import type { XY } from "../tape.ts";
import type { View } from "../view.ts";
import { type Box, startOf, trace } from "./geometry.ts";

/** Points of one path: paths of few points are stroked in a tenth of the time. */
const POINTS = 200;
/** A corner nearer than this to the last is left out, pixels. */
const NEAR = 0.4;

export class Pen {
  readonly #view: View;
  #path = new Path2D();
  #points = 0;
  #x = Number.NaN;
  #y = Number.NaN;
  readonly paths: Path2D[] = [this.#path];

  constructor(view: View) {
    this.#view = view;
  }

  /** Goes to a place, µm, without a line. */
  moveTo(place: XY): void {
    [this.#x, this.#y] = this.#view.toPixel(place);
    this.#path.moveTo(this.#x, this.#y);
  }

  readonly #lineTo = (x: number, y: number): void => {
    const px = this.#view.x + x * this.#view.scale;
    const py = this.#view.y - y * this.#view.scale;
    if (Math.abs(px - this.#x) < NEAR && Math.abs(py - this.#y) < NEAR) return;
    if (++this.#points > POINTS) {
      this.#path = new Path2D();
      this.paths.push(this.#path);
      this.#path.moveTo(this.#x, this.#y);
      this.#points = 0;
    }
    this.#path.lineTo(px, py);
    this.#x = px;
    this.#y = py;
  };

  lineTo([x, y]: XY): void {
    this.#lineTo(x, y);
  }

  /** A contour; one that is smaller than a pixel is a dot. */
  edges(edges: readonly (readonly number[])[]): void {
    let [lastX, lastY] = [Number.NaN, Number.NaN];
    for (const edge of edges) {
      const [x, y] = startOf(edge);
      if (x !== lastX || y !== lastY) this.moveTo([x, y]);
      trace(edge, this.#view.scale, this.#lineTo);
      [lastX, lastY] = [edge[2] as number, edge[3] as number];
    }
  }

  stroke(context: CanvasRenderingContext2D): void {
    for (const path of this.paths) context.stroke(path);
  }
}

/** One path of edges, for a stroke that may not cover itself twice. */
export function pathOf(edges: readonly (readonly number[])[], view: View): Path2D {
  const pen = new Pen(view);
  pen.edges(edges);
  const path = new Path2D();
  for (const each of pen.paths) path.addPath(each);
  return path;
}

/** The visible area of the part on so many pixels, with a margin, µm. */
export function seenBox(view: View, [width, height]: XY, margin: number): Box {
  const [left, bottom] = view.toPlace([-margin, height + margin]);
  const [right, top] = view.toPlace([width + margin, -margin]);
  return [left, bottom, right, top];
}

export const isSeen = (box: Box, [left, bottom, right, top]: Box): boolean =>
  box[2] >= left && box[0] <= right && box[3] >= bottom && box[1] <= top;

/** The head of an arrow at a pixel, its direction in radians of the drawing. */
export function arrowHead(path: Path2D, [x, y]: XY, way: number, size = 7): void {
  const corner = (turn: number, length: number): [number, number] => [
    x + length * Math.cos(-way + turn),
    y + length * Math.sin(-way + turn),
  ];
  path.moveTo(...corner(0, size));
  path.lineTo(...corner(2.5, size * 0.8));
  path.lineTo(...corner(-2.5, size * 0.8));
  path.closePath();
}
