/** A tape as ISO G-code, in the dialect of `skg gcode`: whole µm, relative moves, I and J from the start to the centre. */
import { closedMoves, startOf, stretches, type Item } from "./tape.ts";

export function isoText(items: readonly Item[]): string {
  const moves = stretches(items).flatMap(closedMoves);
  const lines = ["G91 G92 X0 Y0"];
  let at = 0;
  for (const item of items) {
    if (item === "D") {
      lines.push("M00");
      continue;
    }
    const [dx, dy] = moves[at++] ?? [0, 0];
    const [sx, sy] = startOf(item);
    const centre = item.sense ? ` I${0 - sx} J${0 - sy}` : "";
    lines.push(`${item.sense ? (item.sense > 0 ? "G03" : "G02") : "G01"} X${dx} Y${dy}${centre}`);
  }
  return [...lines, "M02", ""].join("\n");
}
