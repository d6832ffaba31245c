/** The part on a canvas, to scale: blocks as they come, leads, stops, start holes, direction, the wire's cut, what is chosen and
 * where the controller is. */
import type { Choice, Chooser } from "./choice.ts";
import { onFrame } from "./frame.ts";
import { listenTo } from "./gestures.ts";
import { boxOf, directionAt, distanceFrom, isLine, type Layout, nothing, type Placed, placeAt } from "./placed.ts";
import { drawRuler, roundLength } from "./ruler.ts";
import type { XY } from "./tape.ts";
import { View } from "./view.ts";

/** A curve is drawn as lines that leave it by at most so much, a corner nearer than this to the last is left out: pixels. */
const TOLERANCE = 0.15;
const NEAR = 0.4;
/** Points of one path, and from how many blocks on all is drawn as thin as can be. */
const POINTS = 200;
const MANY = 2000;
/** Pixels of lines that are drawn in one frame, and what the wire's cut may cost: points times its width. What is more comes in
 * the next frames, and a wider cut is left out. */
const FRAME_PIXELS = 1_500_000;
const CUT_COST = 4_000_000;
/** Marks of one kind that are drawn. */
const MARKS = 3000;
/** A pointer finds blocks within so many pixels. */
const REACH = 12;
const PAN_STEP = 60;
const ZOOM_STEP = 1.25;
/** Arrow heads stand no nearer to each other than this, pixels. */
const ARROWS = 90;

type Box = [number, number, number, number];

export interface Colours {
  wire: string;
  lead: string;
  chosen: string;
  walk: string;
  ruler: string;
  grid: string;
}

/** The controller's position, for the picture of the wire. */
export interface Wire {
  place: XY;
  at: number;
  done: number;
}

/** What an underlay gets: the window, the tape and its bounds in µm, the wire and its diameter. */
export interface Scene {
  view: View;
  layout: Layout;
  extent: Box;
  walk: Wire;
  wire: number;
}

/** A picture under the wire, in the place of the plain drawing; true: it wants to be drawn again. */
export interface Underlay {
  draw(context: CanvasRenderingContext2D, scene: Scene): boolean;
}

export class Drawing {
  readonly view = new View();
  #underlay: Underlay | undefined;
  readonly #base: HTMLCanvasElement;
  readonly #over: HTMLCanvasElement;
  readonly #chooser: Chooser;
  #layout: Layout = nothing();
  #boxes: Box[] = [];
  #extent: Box | undefined;
  #colours: Colours = { wire: "#000", lead: "#000", chosen: "#000", walk: "#000", ruler: "#000", grid: "#ccc" };
  #wireWidth = 0;
  #walk: Wire | undefined;
  /** The visitor has looked closer: the window stays where it is. */
  #isHeld = false;
  #drawn = 0;
  #needsAll = true;
  readonly #drawSoon = onFrame(() => this.draw());
  #pixels = 1;
  #size: XY = [300, 200];
  #since = ARROWS;
  /** The places of arrow heads drawn so far. */
  readonly #heads = new Set<number>();
  #grid = false;
  #from: XY | undefined;
  #isMeasuring = false;
  /** Called with the place under the pointer, µm, or undefined; `from`: where a measure began. */
  onPoint: ((place: XY | undefined, from: XY | undefined) => void) | undefined;

  constructor(base: HTMLCanvasElement, over: HTMLCanvasElement, chooser: Chooser) {
    this.#base = base;
    this.#over = over;
    this.#chooser = chooser;
    new ResizeObserver(() => this.#resize()).observe(base);
    chooser.onChange((choice, by) => {
      if (by !== this) this.#bringIn(choice);
      this.#ask(false);
    });
    this.#listen();
    this.#resize();
  }

  /** Another tape; what is drawn of it comes with `grown`. */
  show(layout: Layout): void {
    this.#layout = layout;
    this.#boxes = [];
    this.#extent = undefined;
    this.#isHeld = false;
    this.#walk = undefined;
    this.#note();
    this.fit();
  }

  /** The layout has more blocks than before; `again`: what was there is not the same either. */
  grown(again = false): void {
    this.#note();
    if (!this.#isHeld && this.#extent && (again || !this.#isInside(this.#extent))) this.fit();
    else this.#ask(again);
  }

  #note(): void {
    const { blocks } = this.#layout;
    for (let at = this.#boxes.length; at < blocks.length; at++) {
      const box = boxOf(blocks[at] as Placed);
      this.#boxes.push(box);
      this.#extent = this.#extent
        ? [
            Math.min(this.#extent[0], box[0]),
            Math.min(this.#extent[1], box[1]),
            Math.max(this.#extent[2], box[2]),
            Math.max(this.#extent[3], box[3]),
          ]
        : box;
    }
  }

  fit(): void {
    this.#isHeld = false;
    if (this.#extent) this.view.fit(this.#extent, ...this.#size);
    this.#ask(true);
  }

  zoom(by: number, about: XY = [this.#size[0] / 2, this.#size[1] / 2]): void {
    this.#isHeld = true;
    this.view.zoom(by, about);
    this.#ask(true);
  }

  pan(dx: number, dy: number): void {
    this.#isHeld = true;
    this.view.pan(dx, dy);
    this.#ask(true);
  }

  /** Diameter of the wire whose cut is drawn, mm; 0: none. */
  set wireWidth(wire: number) {
    this.#wireWidth = wire * 1000;
    this.#ask(true);
  }

  set colours(colours: Colours) {
    this.#colours = colours;
    this.#ask(true);
  }

  /** Drawn while the wire is on its way, for a tape that is not too long. */
  set underlay(underlay: Underlay | undefined) {
    this.#underlay = underlay;
    this.#ask(false);
  }

  /** The drawing as it is seen, on a background; on the canvas that is given, or on a new one. */
  picture(background: string, onto = document.createElement("canvas")): HTMLCanvasElement {
    this.draw();
    const { width, height } = this.#base;
    if (onto.width !== width || onto.height !== height) Object.assign(onto, { width, height });
    const context = onto.getContext("2d");
    if (!context) return onto;
    context.fillStyle = background;
    context.fillRect(0, 0, width, height);
    for (const canvas of [this.#base, this.#over]) context.drawImage(canvas, 0, 0);
    return onto;
  }

  /** Lines of a grid, and the axes. */
  set grid(isOn: boolean) {
    this.#grid = isOn;
    this.#ask(true);
  }

  get isMeasuring(): boolean {
    return this.#isMeasuring;
  }

  /** The next press is where a measure begins. */
  set isMeasuring(isOn: boolean) {
    this.#isMeasuring = isOn;
    this.#from = undefined;
    this.#ask(false);
  }

  set walk(walk: Wire | undefined) {
    this.#walk = walk;
    if (walk && this.#isHeld) this.#follow(walk.place);
    this.#ask(false);
  }

  /** The wire stays in the window, however close that is. */
  #follow(place: XY): void {
    const [x, y] = this.view.toPixel(place);
    const [width, height] = this.#size;
    const margin = Math.min(width, height) / 8;
    if (x > margin && y > margin && x < width - margin && y < height - margin) return;
    this.view.pan(width / 2 - x, height / 2 - y);
    this.#ask(true);
  }

  #isInside([left, bottom, right, top]: Box): boolean {
    const [x0, y0] = this.view.toPixel([left, top]);
    const [x1, y1] = this.view.toPixel([right, bottom]);
    return x0 >= 0 && y0 >= 0 && x1 <= this.#size[0] && y1 <= this.#size[1];
  }

  #resize(): void {
    const { clientWidth, clientHeight } = this.#base;
    if (!clientWidth || !clientHeight) return;
    this.#pixels = Math.min(2, devicePixelRatio || 1);
    this.#size = [clientWidth, clientHeight];
    for (const canvas of [this.#base, this.#over]) {
      canvas.width = Math.round(clientWidth * this.#pixels);
      canvas.height = Math.round(clientHeight * this.#pixels);
    }
    if (this.#isHeld) this.#ask(true);
    else this.fit();
  }

  #ask(all: boolean): void {
    this.#needsAll ||= all;
    this.#drawSoon();
  }

  /** Draws what is new, or all when something else has changed. */
  draw(): void {
    const began = performance.now();
    const context = this.#base.getContext("2d");
    if (!context) return;
    context.setTransform(this.#pixels, 0, 0, this.#pixels, 0, 0);
    const { blocks } = this.#layout;
    if (this.#needsAll || this.#drawn > blocks.length) {
      context.clearRect(0, 0, ...this.#size);
      this.#needsAll = false;
      this.#drawn = 0;
      this.#since = ARROWS;
      this.#heads.clear();
      if (this.#grid) this.#gridLines(context);
      drawRuler(context, this.view, this.#size, this.#colours.ruler);
      this.#marks(context);
    }
    if (this.#drawn < blocks.length) {
      const from = this.#drawn;
      this.#drawn = this.#reach(from);
      this.#curves(context, from, this.#drawn);
      if (this.#drawn < blocks.length) this.#drawSoon();
    }
    this.#overlay();
    // (for who looks at the page from outside: the window, and how long this took, ms)
    const { scale, x, y } = this.view;
    Object.assign(this.#base.dataset, { window: `${scale} ${x} ${y} ${this.#pixels}`, took: String(performance.now() - began) });
  }

  /** The block behind the last one for which there is time in a frame. */
  #reach(from: number): number {
    const { blocks } = this.#layout;
    const most = this.#size[0] + this.#size[1];
    let pixels = 0;
    let at = from;
    for (; at < blocks.length && pixels < FRAME_PIXELS; at++) {
      pixels += 4 + Math.min(most, (blocks[at] as Placed).length * this.view.scale);
    }
    return at;
  }

  #curves(context: CanvasRenderingContext2D, from: number, to: number): void {
    const part = to < this.#layout.blocks.length || from ? this.#layout.blocks.slice(from, to) : this.#layout.blocks;
    const cut = this.#trace(0, ({ role }) => role === "cut", part);
    const leads = this.#trace(0, ({ role }) => role !== "cut", part);
    context.lineJoin = "round";
    const width = this.#wireWidth * this.view.scale;
    if (width > 1.5 && cut.length * POINTS * Math.min(width, this.#size[0] + this.#size[1]) < CUT_COST) {
      context.save();
      context.globalAlpha = 0.25;
      context.lineCap = "round";
      context.strokeStyle = this.#colours.wire;
      context.lineWidth = this.#wireWidth * this.view.scale;
      const whole = new Path2D();
      for (const path of cut) whole.addPath(path);
      context.stroke(whole);
      context.restore();
    }
    // Lines of one pixel are far cheaper than wider ones.
    context.lineWidth = this.#layout.blocks.length > MANY ? 1 / this.#pixels : 1.25;
    context.strokeStyle = this.#colours.wire;
    for (const path of cut) context.stroke(path);
    context.setLineDash([5, 4]);
    context.strokeStyle = this.#colours.lead;
    for (const path of leads) context.stroke(path);
    context.setLineDash([]);
    this.#arrows(context, from, to);
  }

  /** Paths of blocks, in pixels, none of many points: so they are drawn in a tenth of the time. Blocks outside of the window are
   * left out. */
  #trace(from: number, wanted: (placed: Placed) => boolean, blocks: readonly Placed[] = this.#layout.blocks): Path2D[] {
    const margin = this.#wireWidth * this.view.scale + 4;
    const [left, bottom] = this.view.toPlace([-margin, this.#size[1] + margin]);
    const [right, top] = this.view.toPlace([this.#size[0] + margin, -margin]);
    const { scale, x: originX, y: originY } = this.view;
    const paths: Path2D[] = [];
    let path = new Path2D();
    let points = POINTS;
    let penX = NaN;
    let penY = NaN;
    const to = (x: number, y: number, always: boolean): void => {
      const px = originX + x * scale;
      const py = originY - y * scale;
      if (!always && Math.abs(px - penX) < NEAR && Math.abs(py - penY) < NEAR) return;
      if (++points > POINTS) {
        path = new Path2D();
        paths.push(path);
        path.moveTo(penX, penY);
        points = 0;
      }
      path.lineTo(px, py);
      penX = px;
      penY = py;
    };
    let last: Placed | undefined;
    for (let at = from; at < blocks.length; at++) {
      const placed = blocks[at] as Placed;
      const box = this.#boxes[placed.number - 1];
      if (!wanted(placed) || (box && (box[0] > right || box[2] < left || box[1] > top || box[3] < bottom))) {
        last = undefined;
        continue;
      }
      if (!last || last.end[0] !== placed.start[0] || last.end[1] !== placed.start[1]) {
        penX = originX + placed.start[0] * scale;
        penY = originY - placed.start[1] * scale;
        path.moveTo(penX, penY);
      }
      last = placed;
      if (!isLine(placed)) this.#arc(placed, to);
      to(placed.end[0], placed.end[1], at === blocks.length - 1);
    }
    return paths;
  }

  /** The places along an arc, so near to each other that it looks round. */
  #arc(placed: Placed, to: (x: number, y: number, always: boolean) => void): void {
    const radius = placed.radius * this.view.scale;
    if (radius * Math.abs(placed.sweep) < NEAR) return;
    const step = 2 * Math.acos(Math.max(0, 1 - TOLERANCE / Math.max(radius, TOLERANCE)));
    const parts = Math.min(20_000, Math.ceil(Math.abs(placed.sweep) / Math.max(step, 1e-6)));
    for (let part = 1; part < parts; part++) {
      const angle = placed.first + (placed.sweep * part) / parts;
      to(placed.centre[0] + placed.radius * Math.cos(angle), placed.centre[1] + placed.radius * Math.sin(angle), false);
    }
  }

  #arrows(context: CanvasRenderingContext2D, from: number, to: number): void {
    const { blocks } = this.#layout;
    const [cut, leads] = [new Path2D(), new Path2D()];
    for (let at = from; at < to; at++) {
      const placed = blocks[at] as Placed;
      const length = placed.length * this.view.scale;
      this.#since += length;
      if (this.#since < ARROWS || length < 14) continue;
      this.#since = 0;
      const [x, y] = this.view.toPixel(placeAt(placed, 0.5));
      const cell = Math.round(x / 8) * 65536 + Math.round(y / 8);
      if (this.#heads.has(cell) || this.#heads.size > MARKS) continue;
      this.#heads.add(cell);
      const way = -directionAt(placed, 0.5);
      const heads = placed.role === "cut" ? cut : leads;
      heads.moveTo(x + 7 * Math.cos(way), y + 7 * Math.sin(way));
      heads.lineTo(x + 5 * Math.cos(way + 2.5), y + 5 * Math.sin(way + 2.5));
      heads.lineTo(x + 5 * Math.cos(way - 2.5), y + 5 * Math.sin(way - 2.5));
      heads.closePath();
    }
    context.fillStyle = this.#colours.wire;
    context.fill(cut);
    context.fillStyle = this.#colours.lead;
    context.fill(leads);
  }

  /** Stops as squares, start holes as circles, and the entry: where the way in meets the contour. */
  #marks(context: CanvasRenderingContext2D): void {
    const { holes, stops, blocks } = this.#layout;
    context.strokeStyle = this.#colours.lead;
    context.fillStyle = this.#colours.lead;
    context.lineWidth = 1.25;
    for (const [x, y] of this.#apart(holes)) {
      context.beginPath();
      context.arc(x, y, 5, 0, 2 * Math.PI);
      context.stroke();
    }
    for (const [x, y] of this.#apart(stops.map(({ at }) => at))) {
      context.strokeRect(x - 7.5, y - 7.5, 15, 15);
    }
    const entries = blocks.filter(({ role }) => role === "in").map(({ end }) => end);
    for (const [x, y] of this.#apart(entries)) {
      context.beginPath();
      context.arc(x, y, 3, 0, 2 * Math.PI);
      context.fill();
    }
  }

  /** Pixels of places in the window, each once. */
  #apart(places: readonly XY[]): XY[] {
    const found = new Map<number, XY>();
    for (const place of places) {
      const [x, y] = this.view.toPixel(place);
      if (x < -20 || y < -20 || x > this.#size[0] + 20 || y > this.#size[1] + 20) continue;
      found.set(Math.round(x) * 65536 + Math.round(y), [x, y]);
      if (found.size > MARKS) break;
    }
    return [...found.values()];
  }

  /** Lines at round places, no nearer to each other than a finger, and the axes. */
  #gridLines(context: CanvasRenderingContext2D): void {
    const step = roundLength(40 / this.view.scale);
    const [left, bottom] = this.view.toPlace([0, this.#size[1]]);
    const [right, top] = this.view.toPlace([this.#size[0], 0]);
    const lines = (isAxis: boolean): void => {
      context.beginPath();
      const wanted = (at: number): boolean => Math.abs(at) < step / 2 === isAxis;
      for (let x = Math.ceil(left / step) * step; x <= right; x += step) {
        if (!wanted(x)) continue;
        const [px] = this.view.toPixel([x, 0]);
        context.moveTo(px, 0);
        context.lineTo(px, this.#size[1]);
      }
      for (let y = Math.ceil(bottom / step) * step; y <= top; y += step) {
        if (!wanted(y)) continue;
        const [, py] = this.view.toPixel([0, y]);
        context.moveTo(0, py);
        context.lineTo(this.#size[0], py);
      }
      context.stroke();
    };
    context.lineWidth = 1;
    context.strokeStyle = this.#colours.grid;
    lines(false);
    context.strokeStyle = this.#colours.lead;
    lines(true);
  }

  #overlay(): void {
    const context = this.#over.getContext("2d");
    if (!context) return;
    context.setTransform(this.#pixels, 0, 0, this.#pixels, 0, 0);
    context.clearRect(0, 0, ...this.#size);
    const { blocks } = this.#layout;
    const isUnder = this.#drawUnder(context);
    const { choice } = this.#chooser;
    const chosen = chosenBlocks(choice, blocks);
    if (chosen.size) {
      context.strokeStyle = this.#colours.chosen;
      context.lineWidth = 4;
      context.lineCap = "round";
      const one = choice && "block" in choice ? blocks[choice.block - 1] : undefined;
      const paths = one ? this.#trace(0, () => true, [one]) : this.#trace(0, (placed) => chosen.has(placed.number));
      for (const path of paths) context.stroke(path);
    }
    if (this.#from) {
      const [x, y] = this.view.toPixel(this.#from);
      context.strokeStyle = this.#colours.chosen;
      context.lineWidth = 2;
      context.beginPath();
      context.arc(x, y, 6, 0, 2 * Math.PI);
      context.stroke();
    }
    const walk = this.#walk;
    if (!walk) return;
    context.strokeStyle = this.#colours.walk;
    context.lineWidth = blocks.length > MANY ? 1 / this.#pixels : 2.5;
    const isCut = ({ role, number }: Placed): boolean => role === "cut" && number <= walk.at;
    if (!isUnder) for (const path of this.#trace(0, isCut)) context.stroke(path);
    const [x, y] = this.view.toPixel(walk.place);
    const present = blocks[walk.at];
    if (present && !isUnder) {
      const part = { ...present, sweep: present.sweep * walk.done, end: walk.place };
      for (const path of this.#trace(0, () => true, [part])) context.stroke(path);
    }
    context.beginPath();
    context.arc(x, y, Math.max(4, (this.#wireWidth / 2) * this.view.scale), 0, 2 * Math.PI);
    context.fillStyle = this.#colours.walk;
    context.fill();
  }

  #drawUnder(context: CanvasRenderingContext2D): boolean {
    const [walk, underlay, extent, layout] = [this.#walk, this.#underlay, this.#extent, this.#layout];
    if (!walk || !underlay || !extent || layout.blocks.length > MANY) return false;
    if (underlay.draw(context, { view: this.view, layout, extent, walk, wire: this.#wireWidth })) this.#ask(false);
    drawRuler(context, this.view, this.#size, this.#colours.ruler);
    return true;
  }

  /** Pans so that what was chosen elsewhere can be seen, when nothing of it can. */
  #bringIn(choice: Choice): void {
    if (!this.#isHeld) return;
    const chosen = chosenBlocks(choice, this.#layout.blocks);
    const [first] = chosen;
    if (first === undefined) return;
    const [width, height] = this.#size;
    const seen = [...chosen].some((number) => {
      const [left, bottom, right, top] = this.#boxes[number - 1] ?? [0, 0, 0, 0];
      const [x0, y0] = this.view.toPixel([left, top]);
      const [x1, y1] = this.view.toPixel([right, bottom]);
      return x1 > 0 && y1 > 0 && x0 < width && y0 < height;
    });
    if (seen) return;
    const [x, y] = this.view.toPixel(placeAt(this.#layout.blocks[first - 1] as Placed, 0.5));
    this.pan(width / 2 - x, height / 2 - y);
  }

  /** The block that is nearest to a pixel, within reach. */
  #nearest(pixel: XY): Placed | undefined {
    const place = this.view.toPlace(pixel);
    const reach = REACH / this.view.scale;
    let best = reach;
    let found: Placed | undefined;
    this.#layout.blocks.forEach((placed, at) => {
      const box = this.#boxes[at];
      if (!box || place[0] < box[0] - best || place[0] > box[2] + best || place[1] < box[1] - best || place[1] > box[3] + best) {
        return;
      }
      const distance = distanceFrom(placed, place);
      if (distance < best) {
        best = distance;
        found = placed;
      }
    });
    return found;
  }

  #listen(): void {
    const canvas = this.#over;
    listenTo(canvas, {
      pan: (dx, dy) => this.pan(dx, dy),
      zoom: (by, about) => this.zoom(by, about),
      hover: (pixel, isPressed) => {
        if (pixel && !isPressed) this.#point(pixel);
        this.onPoint?.(pixel && this.view.toPlace(pixel), pixel && this.#from);
      },
      tap: (pixel) => (this.#isMeasuring ? this.#measure(pixel) : this.#point(pixel)),
    });
    canvas.addEventListener("dblclick", () => this.fit());
    canvas.addEventListener("keydown", (event) => {
      if (event.ctrlKey || event.altKey || event.metaKey) return;
      const action = this.#keys[event.key];
      if (!action) return;
      event.preventDefault();
      action();
    });
  }

  readonly #keys: Record<string, () => void> = {
    "+": () => this.zoom(ZOOM_STEP),
    "=": () => this.zoom(ZOOM_STEP),
    "-": () => this.zoom(1 / ZOOM_STEP),
    "0": () => this.fit(),
    Home: () => this.fit(),
    ArrowLeft: () => this.pan(PAN_STEP, 0),
    ArrowRight: () => this.pan(-PAN_STEP, 0),
    ArrowUp: () => this.pan(0, PAN_STEP),
    ArrowDown: () => this.pan(0, -PAN_STEP),
    n: () => this.step(1),
    p: () => this.step(-1),
  };

  /** The next or the last block is chosen. */
  step(by: number): void {
    const { choice } = this.#chooser;
    const at = choice && "block" in choice ? choice.block : by > 0 ? 0 : this.#layout.blocks.length + 1;
    const next = Math.min(this.#layout.blocks.length, Math.max(1, at + by));
    if (this.#layout.blocks.length) this.#chooser.choose({ block: next });
  }

  /** A measure begins at the end of a block that is near, else where the pointer is; the next press ends it. */
  #measure(pixel: XY): void {
    this.#from = this.#corner(pixel);
    this.#ask(false);
    this.onPoint?.(this.view.toPlace(pixel), this.#from);
  }

  #corner(pixel: XY): XY {
    const block = this.#nearest(pixel);
    const corners = block ? [block.start, block.end] : [];
    const near = corners.find((corner) => {
      const [x, y] = this.view.toPixel(corner);
      return Math.hypot(x - pixel[0], y - pixel[1]) < REACH;
    });
    return near ?? this.view.toPlace(pixel);
  }

  #point(now: XY): void {
    const found = this.#nearest(now);
    if (found) this.#chooser.choose({ block: found.number }, this);
  }
}

/** Numbers of the blocks that a choice means. */
export function chosenBlocks(choice: Choice, blocks: readonly Placed[]): Set<number> {
  if (!choice) return new Set();
  if ("block" in choice) return new Set(choice.block <= blocks.length ? [choice.block] : []);
  return new Set(blocks.filter((placed) => placed.line === choice.line).map((placed) => placed.number));
}
