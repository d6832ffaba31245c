/** 3B tapes: blocks, their geometry in whole µm (docs/spec/tape-3b.md), and the text of tapes in the forms that one meets. */

export type XY = readonly [number, number];
export type Axis = 0 | 1;

/** A block as it stands on the tape; `axis` 0 counts X, 1 Y; `sense` 0 is a line, 1 NR, −1 SR. */
export interface Block {
  readonly x: number;
  readonly y: number;
  readonly j: number;
  readonly axis: Axis;
  readonly sense: -1 | 0 | 1;
  readonly quadrant: number;
}

/** A tape's lines in order; `D` is a stop. `DD`, its end, is none of them. */
export type Item = Block | "D";

const SIGNS: readonly XY[] = [
  [0, 0],
  [1, 1],
  [-1, 1],
  [-1, -1],
  [1, -1],
];
/** µm that an arc may go on past a full circle: its ends are rounded. */
const MAX_OVERLAP = 4;

export const blockText = (b: Block): string =>
  `B${b.x}B${b.y}B${b.j}G${b.axis ? "Y" : "X"}${b.sense ? (b.sense > 0 ? "NR" : "SR") : "L"}${b.quadrant}`;

export const itemText = (item: Item): string => (item === "D" ? "D" : blockText(item));

/** The bytes of a tape, as the punch makes them. */
export const tapeText = (items: readonly Item[]): string => [...items.map(itemText), "DD"].map((line) => `${line}\r\n`).join("");

// Geometry -------------------------------------------------------------------------------------------------

function root(n: bigint): bigint {
  let found = BigInt(Math.floor(Math.sqrt(Number(n))));
  while (found * found > n) found--;
  while ((found + 1n) * (found + 1n) <= n) found++;
  return found;
}

/** √(x² + y² − less²) rounded to the nearest whole number, exactly; 0 where there is none. */
function roundRoot(x: number, y: number, less = 0): number {
  const n = BigInt(x) * BigInt(x) + BigInt(y) * BigInt(y) - BigInt(less) * BigInt(less);
  return n <= 0n ? 0 : Number((root(4n * n) + 1n) / 2n);
}

export const radiusOf = (b: Block): number => roundRoot(b.x, b.y);

/** The distance from the centre at which the controller passes an axis on an arc: the least whole number whose square + 1 is x² + y² or more. A tape
 * without drift counts it as the radius. */
function turnOf(b: Block): number {
  const square = BigInt(b.x) * BigInt(b.x) + BigInt(b.y) * BigInt(b.y) - 1n;
  return square > 0n ? Number(root(square - 1n) + 1n) : 0;
}

export const isFullCircle = (b: Block): boolean => b.sense !== 0 && (b.j === 4 * radiusOf(b) || b.j === 4 * turnOf(b));

/** The start of a block: a line at (0, 0), an arc relative to its centre. */
export function startOf(b: Block): XY {
  if (!b.sense) return [0, 0];
  const [sx, sy] = SIGNS[b.quadrant] as XY;
  return [sx * b.x, sy * b.y];
}

/** Tells whether the distance from the centre along `axis` shrinks on an arc in `quadrant`. */
const shrinks = (axis: Axis, quadrant: number, sense: number): boolean => (axis === 0) === ((quadrant % 2 === 1) === sense > 0);

const nextQuadrant = (quadrant: number, sense: number): number => ((quadrant - 1 + sense + 4) % 4) + 1;

/** Distance from the centre along the count axis, and quadrant, of an arc's end. */
function countEnd(b: Block, radius = radiusOf(b)): { distance: number; quadrant: number } {
  let distance = b.axis === 0 ? b.x : b.y;
  let quadrant = b.quadrant;
  let left = b.j;
  for (;;) {
    const falls = shrinks(b.axis, quadrant, b.sense);
    const room = falls ? distance : radius - distance;
    if (left <= room || radius === 0) return { distance: falls ? distance - left : distance + left, quadrant };
    left -= room;
    distance = falls ? 0 : radius;
    quadrant = nextQuadrant(quadrant, b.sense);
  }
}

/** The exact end of a block, relative to the origin of `startOf`. Across the count axis an arc's end is the nearest µm on
 * the circle, but not so near 0 that the count direction would be the other one. */
function endOf(b: Block): XY {
  if (!b.sense) {
    const [sx, sy] = SIGNS[b.quadrant] as XY;
    return [sx * b.x, sy * b.y];
  }
  if (isFullCircle(b)) return startOf(b);
  const { distance, quadrant } = countEnd(b);
  let other = roundRoot(b.x, b.y, distance);
  const least = b.axis === 0 ? distance : distance + 1;
  if (least - 2 <= other && other < least) other = least;
  const [sx, sy] = SIGNS[quadrant] as XY;
  return b.axis === 0 ? [sx * distance, sy * other] : [sx * other, sy * distance];
}

/** From start to end. */
export function moveOf(b: Block): XY {
  const [xs, ys] = startOf(b);
  const [xe, ye] = endOf(b);
  return [xe - xs, ye - ys];
}

/** An arc's signed sweep in radians, 0 for a line. */
export function sweepOf(b: Block): number {
  if (!b.sense) return 0;
  if (isFullCircle(b)) return 2 * Math.PI * b.sense;
  const [xs, ys] = startOf(b);
  const [xe, ye] = endOf(b);
  let turn = modulo(b.sense * (Math.atan2(ye, xe) - Math.atan2(ys, xs)), 2 * Math.PI);
  // An end rounded to just behind the start of a short arc is no full turn, nor is the reverse.
  const quarters = modulo((countEnd(b).quadrant - b.quadrant) * b.sense, 4);
  if (quarters === 0 && turn > 1.5 * Math.PI && b.j < 2 * radiusOf(b)) turn = 0;
  if (quarters === 0 && turn < Math.PI / 2 && b.j > 2 * radiusOf(b)) turn += 2 * Math.PI;
  return b.sense * turn;
}

const modulo = (value: number, by: number): number => ((value % by) + by) % by;

/** The error in this block, in the words of `skg check`; empty when it is sound. */
export function problem(b: Block): string {
  if (!b.x && !b.y) return "x and y are both 0";
  if (!b.sense) {
    if (!(b.quadrant % 2 ? b.x : b.y)) return "wrong quadrant for its x and y";
    if (b.j !== Math.max(b.x, b.y)) return `J = ${b.j} is not the larger of x and y`;
    return "";
  }
  const axis: Axis = shrinks(0, b.quadrant, b.sense) ? 0 : 1;
  if (!(axis === 0 ? b.x : b.y)) return "wrong quadrant for its x and y";
  if (!b.j) return "J is 0";
  if (b.j > 4 * Math.max(radiusOf(b), turnOf(b)) + MAX_OVERLAP) return `J = ${b.j} is more than a full circle`;
  if (!isFullCircle(b)) {
    const lost = [radiusOf(b), Math.max(turnOf(b), 1)].every((radius) => {
      const { distance } = countEnd(b, radius);
      return distance > roundRoot(b.x, b.y, distance) + 3;
    });
    if (lost) return "it counts the wrong axis";
  }
  return "";
}

/** The moves of one route's blocks, so that a route that is meant to close does close.
 *
 * A block tells an arc's end exactly along the count axis, but across it only as well as its start gives the radius: where
 * those µm leave a gap that they can explain, the arcs whose end was the closest call give a µm each until it is gone. */
export function* closedMovesSteps(blocks: readonly Block[]): Generator<undefined, XY[]> {
  const moves: [number, number][] = [];
  const doubts: { at: number; doubt: number; across: Axis }[] = [];
  for (const [at, b] of blocks.entries()) {
    if (at % STEP === STEP - 1) yield;
    moves.push([...moveOf(b)]);
    if (b.sense && !isFullCircle(b)) doubts.push({ at, doubt: doubtOf(b), across: b.axis ? 0 : 1 });
  }
  for (const axis of [0, 1] as const) {
    const gap = moves.reduce((sum, move) => sum + move[axis], 0);
    const may = doubts.filter(({ across }) => across === axis);
    if (Math.abs(gap) > may.length) continue;
    const way = gap > 0 ? -1 : 1;
    may.sort((a, b) => way * (b.doubt - a.doubt));
    let left = Math.abs(gap);
    for (const { at } of may) {
      if (!left) break;
      if (!mayGive(blocks[at] as Block, axis, way)) continue;
      (moves[at] as [number, number])[axis] += way;
      left--;
    }
  }
  return moves;
}

/** An arc's unrounded end minus its rounded one, across the count axis, µm. */
function doubtOf(b: Block): number {
  const end = endOf(b);
  const along = end[b.axis];
  const beside = end[b.axis ? 0 : 1];
  return Math.sqrt(Math.max(0, b.x ** 2 + b.y ** 2 - along ** 2)) * (beside >= 0 ? 1 : -1) - beside;
}

function mayGive(b: Block, axis: Axis, way: number): boolean {
  const end = endOf(b);
  const other = Math.abs(end[axis] + way);
  const along = Math.abs(end[axis ? 0 : 1]);
  return b.axis === 0 ? along <= other : along < other;
}

/** The blocks between two stops; an empty list where two stops follow each other. */
export function stretches(items: readonly Item[]): Block[][] {
  const found: Block[][] = [[]];
  for (const item of items) {
    if (item === "D") found.push([]);
    else (found[found.length - 1] as Block[]).push(item);
  }
  return found;
}

// Text -----------------------------------------------------------------------------------------------------

const BLOCK = /B(\d{1,8})B(\d{1,8})B(\d{1,8})G([XY])(L|NR|SR)([1-4])/y;

/** The block on a line of the punch; undefined where there is none. */
export function readBlock(text: string): Block | undefined {
  BLOCK.lastIndex = 0;
  const match = BLOCK.exec(text);
  if (!match || BLOCK.lastIndex !== text.length) return undefined;
  return blockOf(match as unknown as string[]);
}

function blockOf(match: readonly (string | undefined)[]): Block {
  const [, x, y, j, g, kind, quadrant] = match;
  return {
    x: Number(x || 0),
    y: Number(y || 0),
    j: Number(j || 0),
    axis: g?.toUpperCase() === "X" ? 0 : 1,
    sense: kind?.[0]?.toUpperCase() === "L" ? 0 : kind?.[0]?.toUpperCase() === "N" ? 1 : -1,
    quadrant: Number(quadrant),
  };
}

export interface ReadTape {
  items: Item[];
  /** The file is not, byte for byte, what the punch would make of these blocks. */
  isForeign: boolean;
  /** There is no DD at its end. */
  hasNoEnd: boolean;
}

export class TapeError extends Error {
  constructor(
    readonly block: number,
    readonly line: number,
    readonly column: number,
    readonly found: string,
  ) {
    super(`block ${block}, line ${line}, column ${column}: ${found}`);
  }
}

/** Blocks of a step. */
export const STEP = 500;

/** The gap between blocks of other packages' tapes: blanks, line ends, NULs, numbers before blocks (`N1:`, `0001`), and
 * comments from `;`, `(` or `/` to the end of the line. */
const GAP = /(?:[\s\0,.:]|N\s*\d+|\d+(?=[\s:]*B)|[;(/][^\r\n]*)*/iy;
const LOOSE = /B\s*(\d{0,8})\s*B\s*(\d{0,8})\s*B\s*(\d{0,8})\s*G\s*([XY])\s*(L|NR|SR)\s*([1-4])(?!\d)/iy;
const END = /(?:DD|E)(?![A-Z])/iy;
const STOP = /D(?![AC-Z])/iy;

/** Reads a tape as this punch or another package writes it: also with blanks, in small letters, without line ends, with zeros
 * left out, with numbers in front of the blocks. What cannot be read is a `TapeError`. */
export const readTape = (text: string): ReadTape => finish(readTapeSteps(text));

/** Carries out what can be done in steps, in one go. */
export function finish<T>(steps: Generator<undefined, T>): T {
  for (;;) {
    const step = steps.next();
    if (step.done) return step.value;
  }
}

/** The same in steps of some hundred blocks: between them the page may do something else. */
export function* readTapeSteps(text: string): Generator<undefined, ReadTape> {
  const items: Item[] = [];
  let at = 0;
  let blocks = 0;
  let hasNoEnd = true;
  const take = (pattern: RegExp): RegExpExecArray | null => {
    pattern.lastIndex = at;
    const match = pattern.exec(text);
    if (match) at = pattern.lastIndex;
    return match;
  };
  const fail = (found: string): never => {
    const before = text.slice(0, at).split("\n");
    throw new TapeError(blocks + 1, before.length, (before.at(-1) ?? "").length + 1, found);
  };
  for (take(GAP); at < text.length; take(GAP)) {
    if (items.length % STEP === STEP - 1) yield;
    if (take(END)) {
      hasNoEnd = false;
      take(GAP);
      if (at < text.length) fail(shown(text, at));
      break;
    }
    const match = take(LOOSE);
    if (match) {
      const block = blockOf(match);
      blocks++;
      const wrong = problem(block);
      if (wrong) {
        at = match.index;
        blocks--;
        fail(`${blockText(block)}: ${wrong}`);
      }
      items.push(block);
    } else if (take(STOP)) {
      items.push("D");
    } else {
      fail(shown(text, at));
    }
  }
  if (!blocks) fail(shown(text, at));
  return { items, hasNoEnd, isForeign: text.replace(/^\0+|\0+$/g, "") !== tapeText(items) };
}

function shown(text: string, at: number): string {
  const rest = text.slice(at, at + 12).replace(/[\r\n][^]*/, "");
  return at >= text.length ? "" : /^[ -~]+$/.test(rest) ? rest : `${text.charCodeAt(at).toString(16).toUpperCase()}H`;
}
