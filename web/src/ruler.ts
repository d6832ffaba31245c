/** A length on a drawing to read sizes by, and the axes' crossing. */
import type { XY } from "./tape.ts";
import type { View } from "./view.ts";

/** The least of 1, 2, 5, 10… that is not less. */
export function roundLength(wanted: number): number {
  const ten = 10 ** Math.floor(Math.log10(wanted));
  return ten * (wanted <= ten ? 1 : wanted <= 2 * ten ? 2 : wanted <= 5 * ten ? 5 : 10);
}

export function drawRuler(context: CanvasRenderingContext2D, view: View, [, height]: XY, colour: string): void {
  const length = roundLength(55 / view.scale) / 1000;
  const pixels = length * 1000 * view.scale;
  const [x, y] = [12, height - 12];
  context.strokeStyle = context.fillStyle = colour;
  context.lineWidth = 1;
  context.beginPath();
  context.moveTo(x, y - 5);
  context.lineTo(x, y);
  context.lineTo(x + pixels, y);
  context.lineTo(x + pixels, y - 5);
  const [ox, oy] = view.toPixel([0, 0]);
  context.moveTo(ox - 6, oy);
  context.lineTo(ox + 6, oy);
  context.moveTo(ox, oy - 6);
  context.lineTo(ox, oy + 6);
  context.stroke();
  context.font = "12px system-ui, sans-serif";
  context.fillText(
    length >= 0.01 ? `${Number(length.toPrecision(3))} mm` : `${Number((length * 1000).toPrecision(3))} µm`,
    x + 4,
    y - 6,
  );
}
