/** The window of a drawing: µm of the part to pixels of the canvas. */
import type { XY } from "./tape.ts";

export class View {
  /** Pixels for a µm, and the place of (0, 0) in pixels. */
  scale = 0.004;
  x = 0;
  y = 0;

  toPixel([x, y]: XY): XY {
    return [this.x + x * this.scale, this.y - y * this.scale];
  }

  toPlace([x, y]: XY): XY {
    return [(x - this.x) / this.scale, (this.y - y) / this.scale];
  }

  pan(dx: number, dy: number): void {
    this.x += dx;
    this.y += dy;
  }

  /** Zooms about a pixel; between 1 km on the canvas and a thousandth of a µm for a pixel there is nothing to see. */
  zoom(by: number, [x, y]: XY): void {
    const scale = Math.min(1000, Math.max(1e-7, this.scale * by));
    this.x = x + ((this.x - x) * scale) / this.scale;
    this.y = y + ((this.y - y) * scale) / this.scale;
    this.scale = scale;
  }

  /** Shows all of xmin, ymin, xmax, ymax. */
  fit([left, bottom, right, top]: readonly [number, number, number, number], width: number, height: number): void {
    const margin = Math.min(40, width / 10, height / 10);
    const scale = Math.min((width - 2 * margin) / Math.max(right - left, 10), (height - 2 * margin) / Math.max(top - bottom, 10));
    this.scale = Math.max(scale, 1e-7);
    this.x = width / 2 - ((left + right) / 2) * this.scale;
    this.y = height / 2 + ((bottom + top) / 2) * this.scale;
  }
}
