/** The drawing with its plan as a picture that is drawn a little at a time: until it is whole, the last one is shown, moved and
 * scaled to where one looks now. So the page answers within a frame, however much there is to draw. */
import type { XY } from "../tape.ts";
import { View } from "../view.ts";

/** So long may drawing hold up a frame, ms. */
const SLICE = 10;
/** The picture reaches so far beyond the window on each side, as a part of it. */
const MARGIN = 0.25;

/** Draws into a context for a view, in pixels; yields where it may be put off. */
export type Draw = (context: CanvasRenderingContext2D, view: View, size: XY) => Iterator<undefined>;

interface Sheet {
  readonly canvas: HTMLCanvasElement;
  view: View;
}

export class Picture {
  readonly #draw: Draw;
  #shown: Sheet = sheet();
  #drawn: Sheet = sheet();
  #steps: Iterator<undefined> | undefined;
  #isOld = true;
  #hasShown = false;
  #key = "";

  constructor(draw: Draw) {
    this.#draw = draw;
  }

  /** Draws it again: its contents have changed. */
  renew(): void {
    this.#isOld = true;
  }

  /** Another drawing: the last one's picture is not shown any more. */
  clear(): void {
    this.#hasShown = false;
    this.#isOld = true;
    this.#steps = undefined;
  }

  /** Puts the picture as far as it is known on a canvas; true when it is whole, and as one looks now. */
  paint(context: CanvasRenderingContext2D, view: View, size: XY, pixels: number): boolean {
    const key = `${view.scale} ${view.x} ${view.y} ${size} ${pixels}`;
    if (!this.#steps && (this.#isOld || key !== this.#key)) this.#begin(view, size, pixels, key);
    const end = performance.now() + SLICE;
    for (let flush = 0; this.#steps && performance.now() < end; ) {
      const isDone = this.#steps.next().done;
      if (isDone || performance.now() > flush) {
        // (a browser puts strokes off until somebody looks: this is when they take their time)
        this.#drawn.canvas.getContext("2d")?.getImageData(0, 0, 1, 1);
        flush = performance.now() + SLICE / 4;
      }
      if (!isDone) continue;
      this.#steps = undefined;
      [this.#shown, this.#drawn] = [this.#drawn, this.#shown];
      this.#hasShown = true;
    }
    const { canvas, view: was } = this.#hasShown ? this.#shown : this.#drawn;
    const by = view.scale / was.scale;
    const [dx, dy] = [MARGIN * size[0], MARGIN * size[1]];
    context.imageSmoothingEnabled = by !== 1;
    // (whole pixels: a picture that is only moved stays sharp)
    const [x, y] = [view.x - (was.x + dx) * by, view.y - (was.y + dy) * by].map((each) => Math.round(each * pixels));
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.drawImage(canvas, x as number, y as number, canvas.width * by, canvas.height * by);
    return !this.#steps && key === this.#key && !this.#isOld;
  }

  #begin(view: View, size: XY, pixels: number, key: string): void {
    const target = this.#drawn;
    const [width, height] = size.map((each) => Math.round(each * (1 + 2 * MARGIN) * pixels)) as [number, number];
    if (target.canvas.width !== width || target.canvas.height !== height) {
      target.canvas.width = width;
      target.canvas.height = height;
    }
    const context = target.canvas.getContext("2d", { willReadFrequently: true });
    if (!context) return;
    context.setTransform(pixels, 0, 0, pixels, 0, 0);
    context.clearRect(0, 0, size[0] * (1 + 2 * MARGIN), size[1] * (1 + 2 * MARGIN));
    target.view = Object.assign(new View(), { scale: view.scale, x: view.x, y: view.y });
    const inside = Object.assign(new View(), {
      scale: view.scale,
      x: view.x + MARGIN * size[0],
      y: view.y + MARGIN * size[1],
    });
    this.#steps = this.#draw(context, inside, [size[0] * (1 + 2 * MARGIN), size[1] * (1 + 2 * MARGIN)]);
    this.#isOld = false;
    this.#key = key;
  }
}

const sheet = (): Sheet => ({ canvas: document.createElement("canvas"), view: new View() });
