/** The layer above the picture: contours chosen and pointed at, handles, a place of the report, the controller's walk. */
import type { Wire } from "../drawing.ts";
import { isLine, type Placed } from "../placed.ts";
import type { XY } from "../tape.ts";
import type { View } from "../view.ts";
import type { Desk } from "./desk.ts";
import type { Handle } from "./handles.ts";
import { isSeen, Pen, pathOf, seenBox } from "./pen.ts";
import type { Colours } from "./sketch.ts";

/** The chosen contours that are drawn, where they are many. */
const MOST = 3000;

/** A place that wants a decision, µm. */
export interface Ring {
  readonly place: XY;
  readonly isWrong: boolean;
  /** It is the one that the line above the drawing tells of. */
  readonly isPresent: boolean;
}

export class Overlay {
  readonly #desk: Desk;
  readonly #trail = new Trail();
  colours: Colours | undefined;
  /** The contour that is pointed at, and the handle that is held. */
  hovered: number | undefined;
  held: Handle["grip"] | undefined;
  /** A place of the report, µm. */
  place: XY | undefined;
  rings: readonly Ring[] = [];
  /** Places that are measured, µm. */
  measured: readonly XY[] = [];
  /** Two corners of the box that is being drawn, pixels. */
  box: readonly [XY, XY] | undefined;
  walk: Wire | undefined;
  blocks: readonly Placed[] = [];
  /** The block that is pointed at. */
  block: Placed | undefined;

  constructor(desk: Desk) {
    this.#desk = desk;
  }

  draw(context: CanvasRenderingContext2D, view: View, size: XY, handles: readonly Handle[], grip = this.held): void {
    const { colours } = this;
    context.clearRect(0, 0, ...size);
    if (!colours) return;
    context.lineJoin = context.lineCap = "round";
    this.#contours(context, view, size, colours);
    if (this.block) {
      context.strokeStyle = colours.walk;
      context.lineWidth = 5;
      context.stroke(pathOf([edgeOf(this.block)], view));
    }
    if (this.walk) this.#wire(context, view, this.walk, colours);
    for (const handle of handles) drawHandle(context, view, handle, grip === handle.grip, colours);
    for (const { place, isWrong, isPresent } of this.rings) {
      context.strokeStyle = isWrong ? colours.wrong : colours.chosen;
      context.lineWidth = isPresent ? 3.5 : 2;
      context.beginPath();
      context.arc(...view.toPixel(place), isPresent ? 14 : 10, 0, 2 * Math.PI);
      context.stroke();
    }
    this.#drawMeasured(context, view, colours);
    if (this.box) drawBox(context, this.box, colours);
    if (!this.place) return;
    context.strokeStyle = colours.wrong;
    context.lineWidth = 3;
    context.beginPath();
    context.arc(...view.toPixel(this.place), 14, 0, 2 * Math.PI);
    context.stroke();
  }

  #drawMeasured(context: CanvasRenderingContext2D, view: View, { walk }: Colours): void {
    const pixels = this.measured.map((place) => view.toPixel(place));
    context.strokeStyle = context.fillStyle = walk;
    context.lineWidth = 1.5;
    context.beginPath();
    pixels.forEach(([x, y], at) => {
      if (at) context.lineTo(x, y);
      else context.moveTo(x, y);
    });
    context.stroke();
    for (const [x, y] of pixels) {
      context.beginPath();
      context.moveTo(x - 7, y);
      context.lineTo(x + 7, y);
      context.moveTo(x, y - 7);
      context.lineTo(x, y + 7);
      context.stroke();
    }
  }

  #contours(context: CanvasRenderingContext2D, view: View, size: XY, colours: Colours): void {
    const box = seenBox(view, size, 8);
    const draw = (ids: readonly number[], width: number, alpha: number): void => {
      const pen = new Pen(view);
      let count = 0;
      for (const id of ids) {
        const shape = this.#desk.shapes.get(id);
        if (!shape || !isSeen(shape.box, box)) continue;
        pen.edges(shape.edges);
        if (++count >= MOST) break;
      }
      context.globalAlpha = alpha;
      context.strokeStyle = colours.chosen;
      context.lineWidth = width;
      pen.stroke(context);
      context.globalAlpha = 1;
    };
    draw(this.#desk.chosen, 8, 0.5);
    if (this.hovered !== undefined) draw([this.hovered], 6, 0.35);
  }

  #wire(context: CanvasRenderingContext2D, view: View, walk: Wire, colours: Colours): void {
    context.strokeStyle = colours.walk;
    context.lineWidth = this.blocks.length > MOST ? 1 : 2.5;
    this.#trail.stroke(context, view, this.blocks, walk.at);
    const present = this.blocks[walk.at];
    if (present) context.stroke(pathOf([edgeOf(present, walk.done, walk.place)], view));
    context.fillStyle = colours.walk;
    context.beginPath();
    context.arc(...view.toPixel(walk.place), 5, 0, 2 * Math.PI);
    context.fill();
  }
}

/** The way that the controller has gone: what was traced once is kept as long as one looks from the same place. */
class Trail {
  #key = "";
  #of: readonly Placed[] = [];
  #count = 0;
  #paths: Path2D[] = [];

  stroke(context: CanvasRenderingContext2D, view: View, blocks: readonly Placed[], count: number): void {
    const key = `${view.scale} ${view.x} ${view.y}`;
    if (key !== this.#key || blocks !== this.#of || count < this.#count) {
      this.#key = key;
      this.#of = blocks;
      this.#count = 0;
      this.#paths = [];
    }
    if (count > this.#count) {
      const pen = new Pen(view);
      pen.edges(
        blocks
          .slice(this.#count, count)
          .filter(({ role }) => role !== "move")
          .map((each) => edgeOf(each)),
      );
      this.#paths.push(...pen.paths);
      this.#count = count;
    }
    for (const path of this.#paths) context.stroke(path);
  }
}

/** A block, as far as it is done, as an edge. */
function edgeOf(placed: Placed, done = 1, end = placed.end): number[] {
  const ends = [...placed.start, ...end];
  return isLine(placed) ? ends : [...ends, ...placed.centre, placed.sweep * done];
}

function drawBox(context: CanvasRenderingContext2D, [[x0, y0], [x1, y1]]: readonly [XY, XY], colours: Colours): void {
  context.strokeStyle = context.fillStyle = colours.chosen;
  context.lineWidth = 1.5;
  context.setLineDash([5, 4]);
  context.strokeRect(x0, y0, x1 - x0, y1 - y0);
  context.setLineDash([]);
  context.globalAlpha = 0.1;
  context.fillRect(x0, y0, x1 - x0, y1 - y0);
  context.globalAlpha = 1;
}

function drawHandle(
  context: CanvasRenderingContext2D,
  view: View,
  { grip, place }: Handle,
  isHeld: boolean,
  colours: Colours,
): void {
  const [x, y] = view.toPixel(place);
  context.lineWidth = isHeld ? 4 : 2.5;
  context.strokeStyle = colours.chosen;
  context.fillStyle = grip === "entry" ? colours.chosen : colours.panel;
  context.beginPath();
  if (grip === "tab") context.rect(x - 7, y - 7, 14, 14);
  else context.arc(x, y, grip === "start" ? 9 : 7, 0, 2 * Math.PI);
  context.fill();
  context.stroke();
  if (grip !== "start") return;
  context.lineWidth = 1.25;
  context.beginPath();
  context.moveTo(x - 5, y);
  context.lineTo(x + 5, y);
  context.moveTo(x, y - 5);
  context.lineTo(x, y + 5);
  context.stroke();
}
