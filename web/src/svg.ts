/** Pictures of tapes as SVG: the drawing to scale in mm, and the small ones of the part list. */
import { extentOf, isLine, type Layout, type Placed } from "./placed.ts";
import { isFullCircle } from "./tape.ts";

type Number_ = (value: number) => string;

/** Path data of blocks in their order; y grows downwards. `scale` is the picture's unit over a µm. */
export function pathOf(blocks: readonly Placed[], scale: number, write: Number_): string {
  let path = "";
  let pen = "";
  const at = (x: number, y: number): string => `${write(x * scale)} ${write(-y * scale)}`;
  for (const placed of blocks) {
    const [start, end] = [at(...placed.start), at(...placed.end)];
    if (start !== pen) path += `M${start}`;
    pen = end;
    if (isLine(placed)) {
      if (start !== end) path += `L${end}`;
      continue;
    }
    const way = placed.sweep > 0 ? 0 : 1;
    const radius = write(placed.radius * scale);
    if (isFullCircle(placed.block)) {
      const far = at(2 * placed.centre[0] - placed.start[0], 2 * placed.centre[1] - placed.start[1]);
      path += `A${radius} ${radius} 0 1 ${way} ${far}A${radius} ${radius} 0 1 ${way} ${end}`;
    } else if (start !== end) {
      path += `A${radius} ${radius} 0 ${Math.abs(placed.sweep) > Math.PI ? 1 : 0} ${way} ${end}`;
    }
  }
  return path;
}

const exact: Number_ = (value) => String(Number(value.toFixed(6)));

/** A drawing at 1:1 in mm, with the cut of the wire (mm) when that is not 0. Empty without blocks. */
export function svgText(layout: Layout, wire: number, title: string): string {
  const box = extentOf(layout.blocks);
  if (!box) return "";
  const margin = 2 + wire;
  const [left, top] = [box[0] / 1000 - margin, -box[3] / 1000 - margin];
  const [width, height] = [(box[2] - box[0]) / 1000 + 2 * margin, (box[3] - box[1]) / 1000 + 2 * margin];
  const cut = pathOf(
    layout.blocks.filter(({ role }) => role === "cut"),
    0.001,
    exact,
  );
  const leads = pathOf(
    layout.blocks.filter(({ role }) => role !== "cut"),
    0.001,
    exact,
  );
  const line = Math.max(width, height) / 800;
  const numbers = [width, height].map(exact);
  const escaped = title.replace(/[&<>"]/g, (sign) => `&#${sign.charCodeAt(0)};`);
  return (
    `<svg xmlns="http://www.w3.org/2000/svg" width="${numbers[0]}mm" height="${numbers[1]}mm" ` +
    `viewBox="${[left, top, width, height].map(exact).join(" ")}" fill="none" stroke-linejoin="round" stroke-linecap="round">\n` +
    `<title>${escaped}</title>\n` +
    (wire ? `<path id="kerf" stroke="#0072b2" stroke-opacity="0.25" stroke-width="${exact(wire)}" d="${cut}"/>\n` : "") +
    `<path id="wire" stroke="#0072b2" stroke-width="${exact(line)}" d="${cut}"/>\n` +
    (leads
      ? `<path id="leads" stroke="#666" stroke-width="${exact(line)}" stroke-dasharray="${exact(4 * line)}" d="${leads}"/>\n`
      : "") +
    layout.holes
      .map(
        ([x, y]) =>
          `<circle stroke="#666" stroke-width="${exact(line)}" ` +
          `cx="${exact(x / 1000)}" cy="${exact(-y / 1000)}" r="${exact(6 * line)}"/>\n`,
      )
      .join("") +
    "</svg>\n"
  );
}

/** Path data in a square of `size`, and nothing else: for the part list. */
export function thumbnail(layout: Layout, size: number): string {
  const cut = layout.blocks.filter(({ role }) => role === "cut");
  const box = extentOf(cut);
  if (!box) return "";
  const scale = (size - 4) / Math.max(box[2] - box[0], box[3] - box[1], 1);
  const [dx, dy] = [size / 2 - ((box[0] + box[2]) / 2) * scale, size / 2 + ((box[1] + box[3]) / 2) * scale];
  const moved = cut.map(
    (placed): Placed => ({
      ...placed,
      start: [placed.start[0] + dx / scale, placed.start[1] - dy / scale],
      end: [placed.end[0] + dx / scale, placed.end[1] - dy / scale],
      centre: [placed.centre[0] + dx / scale, placed.centre[1] - dy / scale],
    }),
  );
  return pathOf(moved, scale, (value) => String(Number(value.toFixed(1))));
}
