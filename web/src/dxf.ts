/** The wire's path as a DXF drawing (R12, mm), with the layers of `skg dxf`: WIRE what is cut, LEAD the way in and back, MOVES
 * from hole to hole, START and STOPS points. Blocks meet at the whole µm of the tape. */
import { isLine, type Layout, type Placed, type Role } from "./placed.ts";
import { isFullCircle, type XY } from "./tape.ts";

const LAYERS: readonly (readonly [string, number])[] = [
  ["WIRE", 5],
  ["LEAD", 3],
  ["MOVES", 8],
  ["START", 1],
  ["STOPS", 6],
];

const pair = (code: number, value: string | number): string => `${String(code).padStart(3)}\n${value}\n`;
const mm = (micrometres: number): string => String(Number((micrometres / 1000).toFixed(9)));
const point = ([x, y]: XY, code = 10): string => pair(code, mm(x)) + pair(code + 10, mm(y)) + pair(code + 20, 0);
const degrees = (angle: number): string => String(Number(((((angle * 180) / Math.PI) % 360) + 360).toFixed(9)) % 360);

function entity(placed: Placed, layer: string): string {
  const head = (kind: string): string => pair(0, kind) + pair(8, layer);
  const turned = Math.abs(placed.sweep) < 1e-6 || placed.sweep * placed.block.sense < 0;
  if (isLine(placed) || turned) return head("LINE") + point(placed.start) + point(placed.end, 11);
  const circle = point(placed.centre) + pair(40, mm(placed.radius));
  if (isFullCircle(placed.block)) return head("CIRCLE") + circle;
  const [low, high] =
    placed.sweep > 0 ? [placed.first, placed.first + placed.sweep] : [placed.first + placed.sweep, placed.first];
  return head("ARC") + circle + pair(50, degrees(low)) + pair(51, degrees(high));
}

/** The layer of a block. The way back to the start hole has none: it lies on the way in, which is drawn. */
const LAYER_OF: Record<Role, string | undefined> = { cut: "WIRE", in: "LEAD", back: undefined, move: "MOVES" };

export function dxfText(layout: Layout): string {
  const layers = LAYERS.map(
    ([name, colour]) => pair(0, "LAYER") + pair(2, name) + pair(70, 0) + pair(62, colour) + pair(6, "CONTINUOUS"),
  );
  const points = (places: readonly XY[], layer: string): string[] =>
    places.map((place) => pair(0, "POINT") + pair(8, layer) + point(place));
  const stops = [...new Map(layout.stops.map(({ at }) => [at.join(), at])).values()];
  return [
    pair(0, "SECTION"),
    pair(2, "HEADER"),
    pair(9, "$ACADVER"),
    pair(1, "AC1009"),
    pair(9, "$INSUNITS"),
    pair(70, 4),
    pair(9, "$PDMODE"),
    pair(70, 34),
    pair(9, "$PDSIZE"),
    pair(40, 1),
    pair(0, "ENDSEC"),
    pair(0, "SECTION"),
    pair(2, "TABLES"),
    pair(0, "TABLE"),
    pair(2, "LTYPE"),
    pair(70, 1),
    pair(0, "LTYPE"),
    pair(2, "CONTINUOUS"),
    pair(70, 64),
    pair(3, "Solid line"),
    pair(72, 65),
    pair(73, 0),
    pair(40, 0),
    pair(0, "ENDTAB"),
    pair(0, "TABLE"),
    pair(2, "LAYER"),
    pair(70, LAYERS.length),
    ...layers,
    pair(0, "ENDTAB"),
    pair(0, "ENDSEC"),
    pair(0, "SECTION"),
    pair(2, "ENTITIES"),
    ...layout.blocks.flatMap((placed) => {
      const layer = LAYER_OF[placed.role];
      return layer ? [entity(placed, layer)] : [];
    }),
    ...points(layout.holes, "START"),
    ...points(stops, "STOPS"),
    pair(0, "ENDSEC"),
    pair(0, "EOF"),
  ].join("");
}
