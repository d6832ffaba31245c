/** Draws the contours with their plan: the wire's band, holes, leads, entries, tabs, directions and numbers. */
import type { XY } from "../tape.ts";
import type { View } from "../view.ts";
import type { Desk } from "./desk.ts";
import {
  boxOf,
  goesWith,
  lengthOfAll,
  micrometres,
  nearest,
  type OnContour,
  placeAlong,
  type Shape,
  wayToEntry,
  wrapped,
} from "./geometry.ts";
import { copiesOf, drawZero } from "./lying.ts";
import { arrowHead, isSeen, Pen, pathOf, seenBox } from "./pen.ts";
import type { Planned, Point } from "./types.ts";
import { MOST as MOST_WAYS, type WireWays } from "./ways.ts";

export interface Colours {
  wire: string;
  lead: string;
  chosen: string;
  walk: string;
  ruler: string;
  wrong: string;
  panel: string;
  text: string;
}

/** Contours that are drawn between two looks at the clock. */
const STEP = 100;
/** Only a contour of so many pixels has its direction and band drawn. */
const LARGE = 10;
/** Arrow heads stand this far apart, pixels. */
const ARROWS = 110;
/** The height of a number, and of a cell in which they are looked for, pixels; a number is no wider. */
const LABEL = 12;
const CELL = 48;
/** Smaller letters are not drawn, pixels. A letter's size for the height of a capital; the distance of lines. */
const READABLE = 4;
const CAPITALS = 1.37;
const LINE = 1.67;
const HOLE = 5;
/** Lines that a tab is drawn of. */
const TAB_PARTS = 24;

interface Seen {
  readonly shape: Shape;
  readonly planned: Planned | undefined;
  /** Pixels, the longer side of its box. */
  readonly size: number;
}

export class Sketch {
  readonly #desk: Desk;
  readonly #ways: WireWays;
  colours: Colours | undefined;

  constructor(desk: Desk, ways: WireWays) {
    this.#desk = desk;
    this.#ways = ways;
  }

  /** Contours that can be seen, with what is planned of them. */
  *#seen(view: View, size: XY): Generator<Seen> {
    const box = seenBox(view, size, 20);
    for (const shape of this.#desk.shapes.values()) {
      if (!isSeen(shape.box, box)) continue;
      const [left, bottom, right, top] = shape.box;
      yield {
        shape,
        planned: this.#desk.planned(shape.contour.id),
        size: Math.max(right - left, top - bottom) * view.scale,
      };
    }
  }

  /** Numbers of the contours in the window, where they are many without the smallest. */
  inView(view: View, size: XY): number[] {
    const seen = [...this.#seen(view, size)];
    const wanted = seen.length > MOST_WAYS ? seen.filter((each) => each.size > LARGE) : seen;
    return wanted.map(({ shape }) => shape.contour.id);
  }

  *draw(context: CanvasRenderingContext2D, view: View, size: XY): Generator<undefined> {
    const { colours } = this;
    if (!colours) return;
    const seen = [...this.#seen(view, size)];
    yield;
    context.lineJoin = context.lineCap = "round";
    yield* this.#left(context, view, size, colours);
    yield* this.#copies(context, view, colours);
    yield* this.#bands(context, view, seen, colours);
    yield* this.#lines(context, view, seen, colours);
    yield* this.#marks(context, view, seen, colours);
    yield* this.#directions(context, view, seen, colours);
    yield* this.#numbers(context, view, seen, colours);
    const { lying } = this.#desk.plan;
    if (lying) drawZero(context, view, lying, colours.chosen);
  }

  /** Copies of what is cut, thin: they are cut like the part. */
  *#copies(context: CanvasRenderingContext2D, view: View, colours: Colours): Generator<undefined> {
    const cut = [...this.#desk.shapes.values()].filter(({ contour }) => this.#desk.planned(contour.id)?.cut);
    context.strokeStyle = colours.wire;
    context.lineWidth = 1;
    context.globalAlpha = 0.55;
    for (const edges of copiesOf(
      this.#desk.plan.lying,
      cut.flatMap((shape) => shape.edges),
    )) {
      const pen = new Pen(view);
      pen.edges(edges);
      pen.stroke(context);
      yield;
      context.globalAlpha = 0.55;
    }
    context.globalAlpha = 1;
  }

  *#bands(context: CanvasRenderingContext2D, view: View, seen: readonly Seen[], { wire }: Colours): Generator<undefined> {
    const width = this.#kerf() * view.scale;
    context.strokeStyle = wire;
    for (const { shape, planned, size } of seen) {
      if (!planned?.cut || size < LARGE) continue;
      const ways = this.#ways.of(shape.contour.id);
      const radius = Math.abs(planned.radius ?? 0) * 1000;
      const band = ways ? width : 2 * radius * view.scale + width;
      if (band < 1.5) continue;
      context.globalAlpha = ways ? 0.28 : 0.14;
      context.lineWidth = band;
      if (ways) for (const way of ways) context.stroke(pathOf(way, view));
      else context.stroke(pathOf(shape.edges, view));
      yield;
    }
    context.globalAlpha = 1;
  }

  /** The width of the cut, µm: the wire and a spark gap on each side. */
  #kerf(): number {
    const { wire, gap, offset } = this.#desk.edited.job.machine ?? {};
    const number = (value: unknown): number => (typeof value === "number" ? value : 0);
    return (wire === undefined ? 2 * number(offset) : number(wire) + 2 * number(gap)) * 1000;
  }

  *#lines(context: CanvasRenderingContext2D, view: View, seen: readonly Seen[], colours: Colours): Generator<undefined> {
    const isWrong = ({ shape, planned }: Seen): boolean => Boolean(planned?.error) || this.#ways.hasNoRoom(shape.contour.id);
    const kinds: [string, number, (each: Seen) => boolean][] = [
      [colours.lead, 1, (each) => !each.planned?.cut && !isWrong(each)],
      [colours.wire, 1.5, (each) => each.planned?.cut === true && !isWrong(each)],
      [colours.wrong, 2.5, isWrong],
    ];
    for (const [colour, width, isWanted] of kinds) {
      const wanted = seen.filter(isWanted);
      context.strokeStyle = colour;
      context.lineWidth = seen.length > 2000 ? 1 : width;
      for (let at = 0; at < wanted.length; at += STEP) {
        const pen = new Pen(view);
        for (const { shape } of wanted.slice(at, at + STEP)) pen.edges(shape.edges);
        pen.stroke(context);
        yield;
      }
    }
  }

  *#marks(context: CanvasRenderingContext2D, view: View, seen: readonly Seen[], colours: Colours): Generator<undefined> {
    context.strokeStyle = context.fillStyle = colours.lead;
    const wanted = seen.filter(({ planned, size }) => planned?.cut && planned.hole && size > 4);
    const radius = (size: number): number => Math.min(HOLE, Math.max(1.5, size / 5));
    for (let at = 0; at < wanted.length; at += STEP) {
      const [leads, dots] = [new Path2D(), new Path2D()];
      for (const { planned, size } of wanted.slice(at, at + STEP)) {
        const reach = radius(size);
        const entry = planned?.entry && view.toPixel(micrometres(planned.entry));
        const ways: [Point | null | undefined, Point | null | undefined][] = [[planned?.hole, planned?.entry]];
        for (const [begin, end, before, behind] of planned?.tabs ?? []) ways.push([before, begin], [behind, end]);
        for (const [place, end] of ways) {
          if (!place) continue;
          const [x, y] = view.toPixel(micrometres(place));
          leads.moveTo(x + reach, y);
          leads.arc(x, y, reach, 0, 2 * Math.PI);
          if (!end) continue;
          leads.moveTo(x, y);
          leads.lineTo(...view.toPixel(micrometres(end)));
        }
        if (!entry) continue;
        dots.moveTo(entry[0] + reach * 0.7, entry[1]);
        dots.arc(entry[0], entry[1], reach * 0.7, 0, 2 * Math.PI);
      }
      context.lineWidth = 1.25;
      context.stroke(leads);
      context.fill(dots);
      yield;
    }
    for (const { shape, planned } of wanted) {
      if (!planned?.values.tab) continue;
      context.strokeStyle = colours.chosen;
      context.lineWidth = 5;
      for (const [begin, end] of planned.tabs) context.stroke(pathOf(tabEdges(shape, planned, begin, end), view));
      yield;
    }
  }

  *#directions(context: CanvasRenderingContext2D, view: View, seen: readonly Seen[], colours: Colours): Generator<undefined> {
    context.fillStyle = colours.wire;
    for (const { shape, planned, size } of seen) {
      if (!planned?.cut || !planned.entry || planned.direction === null || size < 2 * LARGE) continue;
      const from = nearest(shape, micrometres(planned.entry));
      const turn = goesWith(from.way, planned.direction) ? 0 : Math.PI;
      const length = lengthOfAll(shape.edges);
      const heads = Math.max(1, Math.min(60, Math.floor((length * view.scale) / ARROWS)));
      const path = new Path2D();
      for (let head = 0; head < heads; head++) {
        const { place, way } = placeAlong(shape, (from.along + ((head + 0.5) * length) / heads) % length);
        arrowHead(path, view.toPixel(place), way + turn);
      }
      context.fill(path);
      yield;
    }
  }

  /** The place in the order of cutting, beside each start hole where there is room. */
  *#numbers(context: CanvasRenderingContext2D, view: View, seen: readonly Seen[], colours: Colours): Generator<undefined> {
    const labels = new Labels();
    context.font = `${LABEL}px system-ui, sans-serif`;
    context.textBaseline = "middle";
    context.lineWidth = 3;
    context.strokeStyle = colours.panel;
    context.fillStyle = colours.text;
    let count = 0;
    for (const { planned, size } of seen) {
      if (!planned?.cut || !planned.number || size < LARGE) continue;
      const place = planned.hole ?? planned.entry;
      const text = String(planned.number);
      const free = place && labels.place(view.toPixel(micrometres(place)), 7 * text.length);
      if (!free) continue;
      context.strokeText(text, ...free);
      context.fillText(text, ...free);
      if (++count % STEP === 0) yield;
    }
  }

  /** What is not cut: lines, dashed and grey, and what is written. */
  *#left(context: CanvasRenderingContext2D, view: View, size: XY, colours: Colours): Generator<undefined> {
    const { edges, notes } = this.#desk.left;
    const box = seenBox(view, size, 20);
    context.strokeStyle = context.fillStyle = colours.lead;
    context.globalAlpha = 0.75;
    context.lineWidth = 1;
    context.setLineDash([6, 4]);
    for (let at = 0; at < edges.length; at += STEP) {
      const pen = new Pen(view);
      pen.edges(edges.slice(at, at + STEP).filter((edge) => isSeen(boxOf([edge]), box)));
      pen.stroke(context);
      yield;
    }
    context.setLineDash([]);
    context.textBaseline = "alphabetic";
    for (const { text, place, up } of notes) {
      const high = Math.hypot(...up) * 1000 * view.scale;
      const [x, y] = micrometres(place);
      if (high < READABLE || !isSeen([x, y, x, y], seenBox(view, size, high * text.length))) continue;
      context.save();
      context.translate(...view.toPixel([x, y]));
      context.rotate(Math.atan2(up[0], up[1]));
      context.font = `${high * CAPITALS}px system-ui, sans-serif`;
      text.split("\n").forEach((line, row) => {
        context.fillText(line, 0, row * high * LINE);
      });
      context.restore();
      yield;
    }
    context.globalAlpha = 1;
  }
}

/** Places for numbers, none over another one. */
class Labels {
  /** Boxes by the cells that they reach into. */
  readonly #taken = new Map<number, (readonly [number, number, number])[]>();

  /** A place beside a pixel for a text of a width, its left end; undefined: there is none. */
  place([x, y]: XY, width: number): XY | undefined {
    const right = x + HOLE + 3;
    const left = x - HOLE - 3 - width;
    const [above, below] = [y - HOLE - 4, y + HOLE + 5];
    for (const place of [
      [right, above],
      [left, above],
      [right, below],
      [left, below],
    ] as XY[]) {
      if (this.#take(place, width)) return place;
    }
    return undefined;
  }

  #take([x, y]: XY, width: number): boolean {
    const cells = [Math.floor(x / CELL), Math.floor((x + width) / CELL)].flatMap((column) =>
      [-1, 0, 1].map((by) => column * 65536 + Math.floor(y / CELL) + by),
    );
    const isTaken = cells.some((cell) =>
      this.#taken.get(cell)?.some(([u, v, wide]) => x < u + wide + 2 && u < x + width + 2 && Math.abs(y - v) < LABEL + 1),
    );
    if (isTaken) return false;
    for (const column of new Set([Math.floor(x / CELL), Math.floor((x + width) / CELL)])) {
      const cell = column * 65536 + Math.floor(y / CELL);
      this.#taken.set(cell, [...(this.#taken.get(cell) ?? []), [x, y, width]]);
    }
    return true;
  }
}

/** The part of a contour that a tab keeps, as lines. */
function tabEdges(shape: Shape, planned: Planned, begin: Point, end: Point): number[][] {
  const [{ along }, to] = [begin, end].map((place) => nearest(shape, micrometres(place))) as [OnContour, OnContour];
  const { isWith } = wayToEntry(shape, along, micrometres(planned.entry ?? end), planned.direction);
  const whole = lengthOfAll(shape.edges);
  const length = wrapped(isWith ? to.along - along : along - to.along, whole);
  const places = Array.from({ length: TAB_PARTS + 1 }, (_, part) => {
    const way = (part * length) / TAB_PARTS;
    return placeAlong(shape, wrapped(isWith ? along + way : along - way, whole)).place;
  });
  return places.slice(1).map((place, at) => [...(places[at] as XY), ...place]);
}
