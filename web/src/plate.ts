/** The steel plate under the wire: the kerf that it leaves, the slug that drops at a stop, the part that stays. */
import type { Scene, Underlay } from "./drawing.ts";
import { isLine, type Placed, type Route } from "./placed.ts";
import type { XY } from "./tape.ts";

export interface Steel {
  light: string;
  dark: string;
  kerf: string;
  /** What is seen through a hole. */
  floor: string;
  spark: string;
}

/** The plate reaches so far beyond the path: a part of its size, and at least so many µm. */
const [MARGIN, LEAST] = [0.06, 3000];
/** The kerf is never thinner on the screen, pixels. */
const KERF = 2.5;
/** A slug falls for so long, ms, and so far, pixels. */
const [FALL, DEPTH] = [700, 34];
/** Sparks fly while the wire has moved within so long, ms. */
const FLYING = 120;
/** A contour is closed when its ends lie so near to each other, µm. */
const CLOSED = 50;
const START_HOLE = 3.5;

const stands = globalThis.matchMedia?.("(prefers-reduced-motion: reduce)");

/** A contour: what lies within it is the slug when its start hole is there, since that is drilled into waste; else the part. */
interface Contour {
  outline: Path2D;
  isSlug: boolean;
  middle: XY;
  /** The block behind its last one. */
  last: number;
}

export class Plate implements Underlay {
  steel: Steel = { light: "#ccc", dark: "#aaa", kerf: "#222", floor: "#fff", spark: "#fa0" };
  #blocks: readonly Placed[] = [];
  #routes = 0;
  #contours: Contour[] = [];
  /** The path that is cut, as far as so many blocks. */
  #kerf = new Path2D();
  #cut = 0;
  /** When each contour was cut through. */
  readonly #fell = new Map<Contour, number>();
  #last: XY = [0, 0];
  #moved = -Infinity;

  /** Draws it all; true while something moves by itself. */
  draw(context: CanvasRenderingContext2D, scene: Scene): boolean {
    const { layout, walk, extent } = scene;
    const now = performance.now();
    this.#learn(context, layout.blocks, layout.routes);
    const done = this.#contours.filter(({ last }) => walk.at >= last || (walk.at === last - 1 && walk.done >= 1));
    for (const contour of this.#fell.keys()) if (!done.includes(contour)) this.#fell.delete(contour);
    for (const contour of done) if (!this.#fell.has(contour)) this.#fell.set(contour, now);
    const parts = done.filter(({ isSlug }) => !isSlug);
    const slugs = done.filter(({ isSlug }) => isSlug);
    context.save();
    this.#inMicrometres(context, scene);
    const steel = this.#steel(context, extent);
    const margin = Math.max(LEAST, MARGIN * Math.max(extent[2] - extent[0], extent[3] - extent[1]));
    const sheet = [
      extent[0] - margin,
      extent[1] - margin,
      extent[2] - extent[0] + 2 * margin,
      extent[3] - extent[1] + 2 * margin,
    ] as const;
    context.fillStyle = this.steel.floor;
    context.fillRect(...sheet);
    context.fillStyle = steel;
    // (when the last one is cut out, what is left around the parts falls back)
    context.globalAlpha = parts.length && done.length === this.#contours.length ? 0.3 : 1;
    context.fillRect(...sheet);
    context.globalAlpha = 1;
    for (const { outline } of parts) context.fill(outline);
    this.#scribe(context, scene);
    this.#cutTo(context, scene);
    let falls = false;
    for (const slug of slugs) falls = this.#through(context, scene, slug, now, steel) || falls;
    context.restore();
    if (walk.place[0] !== this.#last[0] || walk.place[1] !== this.#last[1]) this.#moved = now;
    this.#last = walk.place;
    const flies = now - this.#moved < FLYING && !stands?.matches && layout.blocks[walk.at]?.role !== "move";
    if (flies) this.#sparks(context, scene);
    return falls || flies;
  }

  #inMicrometres(context: CanvasRenderingContext2D, { view: { scale, x, y } }: Scene): void {
    context.transform(scale, 0, 0, -scale, x, y);
    context.lineJoin = context.lineCap = "round";
  }

  #steel(context: CanvasRenderingContext2D, [left, bottom, right, top]: Scene["extent"]): CanvasGradient {
    const gradient = context.createLinearGradient(left, top, right, bottom);
    const { light, dark } = this.steel;
    for (const [at, colour] of [
      [0, light],
      [0.35, dark],
      [0.5, light],
      [1, dark],
    ] as const) {
      gradient.addColorStop(at, colour);
    }
    return gradient;
  }

  /** Contours and start holes of another tape, or of more of it. */
  #learn(context: CanvasRenderingContext2D, blocks: readonly Placed[], routes: readonly Route[]): void {
    if (blocks === this.#blocks && routes.length === this.#routes) return;
    if (blocks !== this.#blocks) this.#fell.clear();
    this.#blocks = blocks;
    this.#routes = routes.length;
    this.#cut = 0;
    this.#kerf = new Path2D();
    this.#contours = routes.flatMap((route) => contourOf(context, blocks, route) ?? []);
  }

  /** The path that is to be cut, and the start holes. */
  #scribe(context: CanvasRenderingContext2D, { layout: { blocks, holes }, walk, view: { scale } }: Scene): void {
    const path = new Path2D();
    for (const placed of blocks.slice(walk.at)) if (placed.role === "cut") trace(path, placed, true);
    context.lineWidth = 1 / scale;
    context.strokeStyle = this.steel.kerf;
    context.globalAlpha = 0.45;
    context.stroke(path);
    context.globalAlpha = 1;
    context.fillStyle = this.steel.kerf;
    for (const [x, y] of holes) {
      context.beginPath();
      context.arc(x, y, START_HOLE / scale, 0, 2 * Math.PI);
      context.fill();
    }
  }

  /** The hole behind a slug, and the slug while it falls; true while it does. */
  #through(
    context: CanvasRenderingContext2D,
    { view: { scale } }: Scene,
    { outline, middle: [x, y] }: Contour,
    now: number,
    steel: CanvasGradient,
  ): boolean {
    context.fillStyle = this.steel.floor;
    context.fill(outline);
    context.stroke(outline);
    const began = [...this.#fell].find(([contour]) => contour.outline === outline)?.[1] ?? 0;
    const part = (now - began) / FALL;
    if (part >= 1 || stands?.matches) return false;
    const size = 1 - 0.2 * part;
    context.save();
    context.clip(outline);
    context.globalAlpha = 1 - part;
    context.translate(x, y - (DEPTH * part * part) / scale);
    context.scale(size, size);
    context.translate(-x, -y);
    context.fillStyle = steel;
    context.fill(outline);
    context.restore();
    return true;
  }

  #cutTo(context: CanvasRenderingContext2D, { layout: { blocks }, walk, view: { scale }, wire }: Scene): void {
    if (walk.at < this.#cut) {
      this.#cut = 0;
      this.#kerf = new Path2D();
    }
    for (; this.#cut < walk.at; this.#cut++) {
      const placed = blocks[this.#cut] as Placed;
      // (from hole to hole the wire is taken out)
      if (placed.role !== "move") trace(this.#kerf, placed, true);
    }
    context.lineWidth = Math.max(wire, KERF / scale);
    context.strokeStyle = this.steel.kerf;
    context.stroke(this.#kerf);
    const present = blocks[walk.at];
    if (!present || present.role === "move") return;
    const begun = new Path2D();
    trace(begun, { ...present, sweep: present.sweep * walk.done, end: walk.place }, true);
    context.stroke(begun);
  }

  #sparks(context: CanvasRenderingContext2D, { view, walk }: Scene): void {
    const [x, y] = view.toPixel(walk.place);
    context.strokeStyle = this.steel.spark;
    context.lineWidth = 1.2;
    context.beginPath();
    for (let spark = 0; spark < 6; spark++) {
      const [way, from, to] = [2 * Math.PI * Math.random(), 4 + 3 * Math.random(), 8 + 9 * Math.random()];
      context.moveTo(x + from * Math.cos(way), y + from * Math.sin(way));
      context.lineTo(x + to * Math.cos(way), y + to * Math.sin(way));
    }
    context.stroke();
  }
}

/** Adds a block to a path in µm. */
function trace(path: Path2D, placed: Placed, moves: boolean): void {
  if (moves) path.moveTo(...placed.start);
  if (isLine(placed)) path.lineTo(...placed.end);
  else path.arc(...placed.centre, placed.radius, placed.first, placed.first + placed.sweep, placed.sweep < 0);
}

/** The closed contour of a route; undefined where the wire only positions, or its path is open. */
function contourOf(
  context: CanvasRenderingContext2D,
  blocks: readonly Placed[],
  { first, last, isMove }: Route,
): Contour | undefined {
  const cut = blocks.slice(first, last).filter(({ role }) => role === "cut");
  const [begin, end, hole] = [cut[0]?.start, cut.at(-1)?.end, blocks[first]?.start];
  if (isMove || !begin || !end || !hole || Math.hypot(begin[0] - end[0], begin[1] - end[1]) > CLOSED) return undefined;
  const outline = new Path2D();
  for (const [at, placed] of cut.entries()) trace(outline, placed, at === 0);
  outline.closePath();
  context.save();
  context.setTransform(1, 0, 0, 1, 0, 0);
  const isSlug = context.isPointInPath(outline, ...hole);
  context.restore();
  const sum = cut.reduce(([x, y], { start }) => [x + start[0], y + start[1]] as const, [0, 0] as readonly [number, number]);
  return { outline, isSlug, middle: [sum[0] / cut.length, sum[1] / cut.length], last };
}
