/** A tape as ISO G-code, in the dialect of `skg gcode` and of the milling ROM (docs/spec/milling.md): absolute places in mm,
 * a stop as M0, a re-positioning as a rapid. The feed is that of `skg gcode` when none is given. */
import { isLine, type Layout, type Placed } from "./placed.ts";
import { startOf, type XY } from "./tape.ts";

const FEED = 100;
const LAST_NUMBER = 9999;

/** Whole µm as mm: at most three decimals, no trailing zeros. */
function millimetres(micrometres: number): string {
  const [whole, part] = [Math.floor(Math.abs(micrometres) / 1000), Math.abs(micrometres) % 1000];
  const decimals = part ? `.${`${part}`.padStart(3, "0").replace(/0+$/, "")}` : "";
  return `${micrometres < 0 ? "-" : ""}${whole}${decimals}`;
}

const pair = (letters: string, [x, y]: XY): string => `${letters[0]}${millimetres(x)}${letters[1]}${millimetres(y)}`;

const grid = ([x, y]: XY): XY => [Math.round(x), Math.round(y)];

const isSame = (one: XY, other: XY): boolean => one[0] === other[0] && one[1] === other[1];

/** Without M30 when the tape has no end. */
export function isoText(layout: Layout, isWhole = true): string {
  const lines: string[] = [];
  const write = (words: string): number => lines.push(`N${(lines.length % LAST_NUMBER) + 1}${words}\r\n`);
  let at = grid(layout.blocks[0]?.start ?? [0, 0]);
  let isFed = false;
  const cut = (words: string): void => {
    write(`${words}${isFed ? "" : `F${FEED}`}`);
    isFed = true;
  };
  const go = (code: string, end: XY): void => {
    if (isSame(at, end)) return;
    (code === "G1" ? cut : write)(`${code}${pair("XY", end)}`);
    at = end;
  };
  const turn = (placed: Placed, end: XY): void => {
    const centre = grid(placed.centre);
    cut(`G${placed.block.sense > 0 ? 3 : 2}${pair("XY", end)}${pair("IJ", [centre[0] - at[0], centre[1] - at[1]])}`);
    at = end;
  };

  write("G17G21G90G94");
  write(`G0${pair("XY", at)}`);
  const stops = layout.stops.map(({ after }) => after);
  for (const placed of layout.blocks) {
    while (stops.length && (stops[0] as number) < placed.number) {
      stops.shift();
      write("M0");
    }
    const end = grid(placed.end);
    if (placed.role === "move") {
      go("G0", end);
    } else if (!isLine(placed) && Math.abs(placed.sweep) > 2 * Math.PI - 1e-9) {
      turn(placed, at); // round once, and the few µm by which a block goes on
      go("G1", end);
    } else if (isLine(placed) || isFlat(placed, at, end)) {
      go("G1", end);
    } else {
      turn(placed, end);
    }
  }
  for (const _ of stops) write("M0");
  if (isWhole) write("M30");
  return lines.join("");
}

/** An arc that a control might take for a full circle: it is within a quarter µm of its chord. */
function isFlat(placed: Placed, at: XY, end: XY): boolean {
  const [[x, y], dx, dy] = [startOf(placed.block), end[0] - at[0], end[1] - at[1]];
  return Math.abs(placed.sweep) <= Math.PI && (dx * dx + dy * dy) ** 2 <= 4 * (x * x + y * y);
}
