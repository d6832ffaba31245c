/** The canvas: contours and plan as a picture, handles above it, pointers and where one looks. */
import type { Wire } from "../drawing.ts";
import { onFrame } from "../frame.ts";
import { boxOf as boxOfBlock, type Placed } from "../placed.ts";
import { drawRuler } from "../ruler.ts";
import type { XY } from "../tape.ts";
import { View } from "../view.ts";
import type { Desk } from "./desk.ts";
import { type Change, change } from "./edits.ts";
import { type Box, micrometres, millimetres } from "./geometry.ts";
import { type Grip, type Handle, handlesOf, stepped } from "./handles.ts";
import { boxWithCopies, WayBack } from "./lying.ts";
import { holesOf, measured, type Picked, pick } from "./measure.ts";
import { Overlay, type Ring } from "./overlay.ts";
import { Picture } from "./picture.ts";
import { listenToPointers } from "./pointing.ts";
import type { Server } from "./server.ts";
import { type Colours, Sketch } from "./sketch.ts";
import type { Point } from "./types.ts";
import { WireWays } from "./ways.ts";

export class Canvas {
  readonly view = new View();
  readonly #desk: Desk;
  readonly #base: HTMLCanvasElement;
  readonly #over: HTMLCanvasElement;
  readonly ways: WireWays;
  readonly #sketch: Sketch;
  readonly #picture: Picture;
  readonly overlay: Overlay;
  readonly #soon = onFrame(() => this.#draw());
  #size: XY = [300, 200];
  #pixels = 1;
  /** One has looked closer: the window stays where it is. */
  #isHeld = false;
  #drag: Handle | undefined;
  /** The name and the box of the drawing that is seen. */
  #part = "";
  #back = new WayBack();
  #copies = "[]";
  /** The pointer's place, mm; undefined: it is elsewhere. */
  onPoint: (place: Point | undefined) => void = () => undefined;
  /** A contour is asked for what can be done with it, at a place of the window. */
  onMenu: (id: number, x: number, y: number) => void = () => undefined;
  /** Places that are measured, while somebody measures. */
  #measured: readonly Picked[] | undefined;
  /** Something was measured, in words; undefined: nobody measures. */
  onMeasured: (text: string | undefined) => void = () => undefined;
  /** A pointer that is dragged draws a box. */
  isBoxing = false;
  /** More is known of the wire's ways. */
  onWays: () => void = () => undefined;

  constructor(base: HTMLCanvasElement, over: HTMLCanvasElement, desk: Desk, server: Server) {
    this.#base = base;
    this.#over = over;
    this.#desk = desk;
    this.ways = new WireWays(desk, server, () => {
      this.#renew();
      this.onWays();
    });
    this.#sketch = new Sketch(desk, this.ways);
    this.#picture = new Picture((context, view, size) => this.#sketch.draw(context, view, size));
    this.overlay = new Overlay(desk);
    new ResizeObserver(() => this.#resize()).observe(base);
    listenToPointers(over, this, desk);
    desk.onChange((news) => {
      if (news.has("drawing")) this.#another();
      if (news.has("selection")) this.hold(undefined);
      if (news.has("selection") && !news.has("drawing")) this.bringIn();
      if (news.has("plan") || news.has("drawing")) this.#renew();
      if (news.has("plan")) this.#copied();
      this.#soon();
    });
  }

  set colours(colours: Colours) {
    this.#sketch.colours = this.overlay.colours = colours;
    this.#renew();
  }

  set walk(wire: Wire | undefined) {
    const walk = wire && { ...wire, place: this.#back.place(wire.place) };
    this.overlay.walk = walk;
    if (walk && this.#isHeld) this.#show([...walk.place, ...walk.place]);
    this.#soon();
  }

  /** Handles where the pointer has them until the plan follows. */
  get handles(): readonly Handle[] {
    const drag = this.#drag;
    return handlesOf(this.#desk).map((handle) => (drag?.grip === handle.grip && drag.id === handle.id ? drag : handle));
  }

  /** The handle that arrow keys move. */
  get held(): Grip | undefined {
    return this.overlay.held;
  }

  /** Takes hold of a handle by keys; false where there is none. */
  hold(grip: Grip | undefined): boolean {
    const has = grip !== undefined && this.handles.some((handle) => handle.grip === grip);
    this.overlay.held = has ? grip : undefined;
    this.#desk.endJoined();
    this.#soon();
    return has;
  }

  /** An arrow key moves what is held. */
  step(way: XY, isFine: boolean): void {
    const handle = this.handles.find(({ grip }) => grip === this.held);
    if (handle) this.want(handle, stepped(this.#desk, handle, way, isFine), `key ${handle.grip}`);
  }

  fit(): void {
    const { state } = this.#desk;
    this.#isHeld = false;
    if (state) {
      const [left, bottom] = micrometres(state.low);
      const [width, height] = micrometres(state.size);
      this.view.fit(boxWithCopies(this.#desk.plan.lying, [left, bottom, left + width, bottom + height]), ...this.#size);
    }
    this.#soon();
  }

  zoom(by: number, about: XY = [this.#size[0] / 2, this.#size[1] / 2]): void {
    this.#isHeld = true;
    this.view.zoom(by, about);
    this.#soon();
  }

  pan(dx: number, dy: number): void {
    this.#isHeld = true;
    this.view.pan(dx, dy);
    this.#soon();
  }

  /** The tape over which the controller walks; `back`: the way from the machine to the drawing. */
  take(blocks: readonly Placed[], back = new WayBack()): void {
    this.#back = back;
    this.overlay.blocks = blocks.map((block) => back.block(block));
    this.overlay.block = undefined;
    this.#soon();
  }

  /** A block of it that is pointed at. */
  showBlock(placed: Placed | undefined): void {
    const block = placed && this.#back.block(placed);
    this.overlay.block = block;
    if (block) this.#show(boxOfBlock(block));
    this.#soon();
  }

  /** A place on the machine, µm. */
  pointOnMachine(place: XY): void {
    this.point(millimetres(this.#back.place(place)));
  }

  /** A place of the report. */
  point(place: Point | undefined): void {
    this.overlay.place = place && micrometres(place);
    if (this.overlay.place) this.#show([...this.overlay.place, ...this.overlay.place]);
    this.#soon();
  }

  get isMeasuring(): boolean {
    return this.#measured !== undefined;
  }

  set isMeasuring(isOn: boolean) {
    this.#measure(isOn ? [] : undefined);
  }

  /** Takes a place to be measured: a third one begins anew. */
  measure(place: XY, reach: number): void {
    const before = this.#measured ?? [];
    const { shapes, state } = this.#desk;
    const picked = pick(shapes.values(), holesOf(state?.starts ?? []), place, reach);
    this.#measure(before.length === 1 ? [...before, picked] : [picked]);
  }

  #measure(picked: readonly Picked[] | undefined): void {
    this.#measured = picked;
    this.overlay.measured = picked?.map(({ place }) => place) ?? [];
    this.sayMeasured();
    this.#soon();
  }

  sayMeasured(): void {
    this.onMeasured(this.#measured && measured(this.#measured));
  }

  /** The box that is being drawn, two corners in pixels. */
  set box(box: readonly [XY, XY] | undefined) {
    this.overlay.box = box;
    this.#soon();
  }

  /** Places that want a decision. */
  set rings(rings: readonly Ring[]) {
    this.overlay.rings = rings;
    this.#soon();
  }

  #another(): void {
    this.ways.forget();
    this.overlay.place = this.overlay.walk = this.overlay.hovered = undefined;
    const { name, low, size } = this.#desk.state ?? {};
    const part = JSON.stringify([name, low, size]);
    if (part === this.#part) return;
    if (this.isMeasuring) this.#measure([]);
    this.#part = part;
    this.#picture.clear();
    this.fit();
  }

  /** Looks at all copies where they are others, but where one has looked closer. */
  #copied(): void {
    const copies = JSON.stringify(this.#desk.plan.lying?.copies ?? []);
    if (copies === this.#copies) return;
    this.#copies = copies;
    if (!this.#isHeld) this.fit();
  }

  #renew(): void {
    this.#picture.renew();
    this.#soon();
  }

  /** Pans so that a part of the drawing is seen, when nothing of it is. */
  #show(box: Box): void {
    const [x0, y0] = this.view.toPixel([box[0], box[3]]);
    const [x1, y1] = this.view.toPixel([box[2], box[1]]);
    const [width, height] = this.#size;
    if (x1 > 0 && y1 > 0 && x0 < width && y0 < height) return;
    this.pan(width / 2 - (x0 + x1) / 2, height / 2 - (y0 + y1) / 2);
  }

  /** Pans to the contour that is chosen, when it is not seen. */
  bringIn(): void {
    const [id, ...others] = this.#desk.chosen;
    const shape = id === undefined || others.length ? undefined : this.#desk.shapes.get(id);
    if (shape && this.#isHeld) this.#show(shape.box);
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
    if (this.#isHeld) this.#soon();
    else this.fit();
  }

  #draw(): void {
    const began = performance.now();
    const [base, over] = [this.#base, this.#over].map((canvas) => canvas.getContext("2d"));
    if (!base || !over || !this.#sketch.colours) return;
    base.setTransform(1, 0, 0, 1, 0, 0);
    base.clearRect(0, 0, this.#base.width, this.#base.height);
    const isWhole = this.#picture.paint(base, this.view, this.#size, this.#pixels);
    base.setTransform(this.#pixels, 0, 0, this.#pixels, 0, 0);
    if (this.#desk.shapes.size) drawRuler(base, this.view, this.#size, this.#sketch.colours.ruler);
    over.setTransform(this.#pixels, 0, 0, this.#pixels, 0, 0);
    this.overlay.draw(over, this.view, this.#size, this.handles, this.#drag?.grip);
    if (!isWhole) this.#soon();
    else if (!this.#drag) void this.ways.want(this.#sketch.inView(this.view, this.#size));
    // (for tests: the window, the time this took, whether the picture is complete, handles in mm)
    const { scale, x, y } = this.view;
    const took = String(performance.now() - began);
    Object.assign(this.#base.dataset, { window: `${scale} ${x} ${y}`, took, whole: String(isWhole) });
    const handles = Object.fromEntries(this.handles.map(({ grip, place }) => [grip, millimetres(place)]));
    this.#over.dataset["handles"] = JSON.stringify(handles);
  }

  /** Changes the settings of a handle's contour. */
  want(handle: Handle, wanted: Change | undefined, joined: string): void {
    if (!wanted) return;
    const { edited, contours } = this.#desk;
    this.#desk.edit(change(edited, { contours: [handle.id] }, wanted, contours), joined);
  }

  /** A handle where the pointer has it. */
  set drag(drag: Handle | undefined) {
    this.#drag = drag;
    this.#soon();
  }

  /** The contour that is pointed at. */
  hover(id: number | undefined): void {
    if (id === this.overlay.hovered) return;
    this.overlay.hovered = id;
    this.#soon();
  }
}
