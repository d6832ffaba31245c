/** Draws the contours with their plan: the wire's band, holes, leads, entries, tabs, directions and numbers. */
import type { XY } from "../tape.ts";
import type { View } from "../view.ts";
import type { Desk } from "./desk.ts";
import {
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
import { arrowHead, isSeen, Pen, pathOf, seenBox } from "./pen.ts";
import type { Planned, Point } from "./types.ts";
import type { WireWays } from "./ways.ts";

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
/** Numbers stand no nearer to each other than this, pixels. */
const CELL: XY = [22, 15];
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

  /** Numbers of the contours in the window, the smallest left out. */
  inView(view: View, size: XY): number[] {
    return [...this.#seen(view, size)].filter((each) => each.size > LARGE).map(({ shape }) => shape.contour.id);
  }

  *draw(context: CanvasRenderingContext2D, view: View, size: XY): Generator<undefined> {
    const { colours } = this;
    if (!colours) return;
    const seen = [...this.#seen(view, size)];
    yield;
    context.lineJoin = context.lineCap = "round";
    yield* this.#bands(context, view, seen, colours);
    yield* this.#lines(context, view, seen, colours);
    yield* this.#marks(context, view, seen, colours);
    yield* this.#directions(context, view, seen, colours);
    yield* this.#numbers(context, view, seen, colours);
  }

  *#bands(context: CanvasRenderingContext2D, view: View, seen: readonly Seen[], { wire }: Colours): Generator<undefined> {
    const width = this.#wire() * view.scale;
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

  /** The wire's diameter, µm. */
  #wire(): number {
    const { wire, offset } = this.#desk.edited.job.machine ?? {};
    return (typeof wire === "number" ? wire : typeof offset === "number" ? 2 * offset : 0) * 1000;
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
    const taken = new Set<number>();
    context.font = "12px system-ui, sans-serif";
    context.textBaseline = "middle";
    context.lineWidth = 3;
    context.strokeStyle = colours.panel;
    context.fillStyle = colours.text;
    let count = 0;
    for (const { planned, size } of seen) {
      if (!planned?.cut || !planned.number || size < LARGE) continue;
      const place = planned.hole ?? planned.entry;
      if (!place) continue;
      const [x, y] = view.toPixel(micrometres(place));
      const cell = Math.round(x / CELL[0]) * 65536 + Math.round(y / CELL[1]);
      if (taken.has(cell)) continue;
      taken.add(cell);
      context.strokeText(String(planned.number), x + HOLE + 3, y - HOLE - 3);
      context.fillText(String(planned.number), x + HOLE + 3, y - HOLE - 3);
      if (++count % STEP === 0) yield;
    }
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
