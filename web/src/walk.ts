/** The controller's walk along a tape, stepped by the C simulator (wasm/walk.c): where it is after any number of steps. */
import { distanceFrom, type Placed, type Route } from "./placed.ts";
import { startOf, type XY } from "./tape.ts";

interface Exports {
  walk_block(sense: number, quadrant: number, x: number, y: number, j: number, axis: number, dx: number, dy: number): void;
  walk_run(budget: number): number;
  walk_x(): number;
  walk_y(): number;
  walk_steps(): number;
  walk_f_max(): number;
  walk_f_min(): number;
  walk_d_max(): number;
  walk_d_min(): number;
}

/** One block as the controller makes it; lengths in µm. */
export interface Walked {
  /** Steps before it, and its own. */
  readonly before: number;
  readonly steps: number;
  /** The controller's positions before it, and behind it. */
  readonly from: XY;
  readonly to: XY;
  /** Largest distance from the line or arc as it should lie. */
  readonly offPath: number;
}

/** The controller's position. */
export interface Position {
  /** Index of the block, and the steps taken in it. */
  readonly at: number;
  readonly step: number;
  readonly place: XY;
  /** Distance from the contour, µm. */
  readonly off: number;
}

/** A block that the controller never ends. */
export class Stalled extends Error {
  constructor(readonly block: number) {
    super(`block ${block}`);
  }
}

const MORE = 1;
const STALLED = 2;
/** Steps that `measure` takes at a time: a few milliseconds. */
const CHUNK = 1_000_000;
/** A block of one step takes as long as so many steps. */
const BEGUN = 50;

export class Walk {
  /** One instance goes through the blocks once, the other to where one looks. */
  readonly #measurer: Exports;
  readonly #wasm: Exports;
  #isMeasuring = false;
  #blocks: readonly Placed[] = [];
  #walked: Walked[] = [];
  /** The block that is stepped now, -1: none. */
  #present = -1;
  #taken = 0;

  constructor(module: WebAssembly.Module) {
    this.#measurer = new WebAssembly.Instance(module, {}).exports as unknown as Exports;
    this.#wasm = new WebAssembly.Instance(module, {}).exports as unknown as Exports;
  }

  get walked(): readonly Walked[] {
    return this.#walked;
  }

  /** All steps of what has been measured. */
  get steps(): number {
    const last = this.#walked.at(-1);
    return last ? last.before + last.steps : 0;
  }

  /** Takes other blocks. */
  begin(blocks: readonly Placed[]): void {
    this.#blocks = blocks;
    this.#walked = [];
    this.#present = -1;
    this.#isMeasuring = false;
  }

  /** Walks on through blocks that were not measured yet, for about so many steps; true when all are. A block that never ends is
   * `Stalled`. */
  measure(budget = CHUNK): boolean {
    let left = budget;
    while (this.#walked.length < this.#blocks.length && left > 0) left -= this.#measureOne(left) + BEGUN;
    return this.#walked.length >= this.#blocks.length;
  }

  /** Takes at most so many steps of the next block; returns how many. */
  #measureOne(budget: number): number {
    const placed = this.#blocks[this.#walked.length] as Placed;
    const from = this.#walked.at(-1)?.to ?? placed.start;
    const wasm = this.#measurer;
    if (!this.#isMeasuring) set(wasm, placed, from);
    const before = this.#isMeasuring ? wasm.walk_steps() : 0;
    const result = wasm.walk_run(budget);
    if (result === STALLED) throw new Stalled(placed.number);
    this.#isMeasuring = result === MORE;
    if (result !== MORE) {
      this.#walked.push({
        before: this.steps,
        steps: wasm.walk_steps(),
        from,
        to: standing(wasm, placed, from),
        offPath: distanceOf(placed, wasm.walk_d_max(), wasm.walk_d_min()),
      });
    }
    return wasm.walk_steps() - before;
  }

  /** The controller's position after `step` of all steps (as far as measured). */
  locate(step: number): Position | undefined {
    if (!this.#walked.length) return undefined;
    const at = this.#find(step);
    const walked = this.#walked[at] as Walked;
    const placed = this.#blocks[at] as Placed;
    const wanted = Math.max(0, Math.min(walked.steps, Math.floor(step - walked.before)));
    if (this.#present !== at || wanted < this.#taken) {
      set(this.#wasm, placed, walked.from);
      this.#present = at;
      this.#taken = 0;
    }
    if (wanted > this.#taken) {
      this.#wasm.walk_run(wanted - this.#taken);
      this.#taken = wanted;
    }
    const place = wanted ? standing(this.#wasm, placed, walked.from) : walked.from;
    return { at, step: wanted, place, off: distanceFrom(placed, place) };
  }

  /** The block in which that step falls. */
  #find(step: number): number {
    let low = 0;
    let high = this.#walked.length - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if ((this.#walked[middle] as Walked).before <= step) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  /** The largest gap between end and start of a cut route, µm; undefined while none has ended. */
  closing(routes: readonly Route[]): XY | undefined {
    let worst: XY | undefined;
    for (const { first, last, isMove } of routes) {
      const [from, to] = [this.#walked[first]?.from, this.#walked[last - 1]?.to];
      if (isMove || !from || !to) continue;
      const gap: XY = [to[0] - from[0], to[1] - from[1]];
      if (!worst || size(gap) > size(worst)) worst = gap;
    }
    return worst;
  }
}

/** Puts a block in, the controller standing at `from`. */
function set(wasm: Exports, { block, start }: Placed, from: XY): void {
  wasm.walk_block(block.sense, block.quadrant, block.x, block.y, block.j, block.axis, from[0] - start[0], from[1] - start[1]);
}

/** The controller's place. */
function standing(wasm: Exports, { block }: Placed, from: XY): XY {
  const [x, y] = startOf(block);
  return [from[0] + wasm.walk_x() - x, from[1] + wasm.walk_y() - y];
}

const size = ([x, y]: XY): number => Math.max(Math.abs(x), Math.abs(y));

/** Extremes of F as the largest distance from the whole line or circle, µm. */
function distanceOf({ block }: Placed, highest: number, lowest: number): number {
  const radius = Math.hypot(block.x, block.y);
  if (!block.sense) return Math.max(highest, -lowest) / radius;
  const square = block.x ** 2 + block.y ** 2;
  return Math.max(Math.sqrt(square + highest) - radius, radius - Math.sqrt(Math.max(0, square + lowest)));
}
