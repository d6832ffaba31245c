/** The punched tape itself: eight tracks and the feed holes, running past under the reader or the punch. */
import { onFrame } from "./frame.ts";

const PITCH = 9;
const TRACKS = 8;
/** The feed holes run between tracks 3 and 4, counted from the edge of the low bits. */
const FEED_AFTER = 3;

export class PunchedTape {
  readonly #canvas: HTMLCanvasElement;
  #text = "";
  #at = 0;
  readonly #ask = onFrame(() => this.#draw());
  colours = { paper: "#f3e9c6", hole: "#222", mark: "#c00" };

  constructor(canvas: HTMLCanvasElement) {
    this.#canvas = canvas;
    new ResizeObserver(() => this.#ask()).observe(canvas);
  }

  /** The tape's characters, and which of them is under the head. */
  show(text: string, at: number): void {
    this.#text = text;
    this.#at = at;
    this.#ask();
  }

  #draw(): void {
    const { clientWidth: width, clientHeight: height } = this.#canvas;
    const context = this.#canvas.getContext("2d");
    if (!context || !width) return;
    const pixels = devicePixelRatio || 1;
    this.#canvas.width = Math.round(width * pixels);
    this.#canvas.height = Math.round(height * pixels);
    context.setTransform(pixels, 0, 0, pixels, 0, 0);
    context.fillStyle = this.colours.paper;
    context.fillRect(0, 0, width, height);
    const row = height / (TRACKS + 2);
    const head = Math.floor(width / 2 / PITCH);
    const first = Math.floor(this.#at) - head;
    const part = this.#at - Math.floor(this.#at);
    context.fillStyle = this.colours.hole;
    context.beginPath();
    const hole = (x: number, y: number, radius: number): void => {
      context.moveTo(x + radius, y);
      context.arc(x, y, radius, 0, 2 * Math.PI);
    };
    for (let column = 0; column * PITCH < width + PITCH; column++) {
      const at = first + column;
      const x = (column - part + 0.5) * PITCH;
      hole(x, row * (FEED_AFTER + 1.5), 1.2);
      const code = at >= 0 && at < this.#text.length ? this.#text.charCodeAt(at) : 0;
      for (let track = 0; track < TRACKS; track++) {
        if (code & (1 << track)) hole(x, row * (track + (track < FEED_AFTER ? 1 : 2)), Math.min(3.2, row * 0.42));
      }
    }
    context.fill();
    context.strokeStyle = this.colours.mark;
    context.lineWidth = 1;
    context.strokeRect(head * PITCH, 0.5, PITCH, height - 1);
  }
}
