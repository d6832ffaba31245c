/** Actions on the chosen contours, by a key or in their menu. */
import { alikeTo } from "./alike.ts";
import type { Desk } from "./desk.ts";
import { type Change, change, isCut, reset, rounded, set } from "./edits.ts";
import { millimetres } from "./geometry.ts";
import type { Side } from "./types.ts";

const SIDES: readonly Side[] = ["auto", "inside", "outside", "on"];
const OPEN_SIDES: readonly Side[] = ["auto", "left", "right", "on"];

export class Actions {
  readonly #desk: Desk;

  constructor(desk: Desk) {
    this.#desk = desk;
  }

  wish(wanted: Change): void {
    const { edited, contours, chosen } = this.#desk;
    if (chosen.length) this.#desk.edit(change(edited, { contours: chosen }, wanted, contours));
  }

  skip(): void {
    const { edited, contours, chosen } = this.#desk;
    this.wish({ cut: !chosen.some((id) => isCut(edited, contours.get(id))) });
  }

  reverse(): void {
    const [id] = this.#desk.chosen;
    if (id !== undefined) this.wish({ reverse: !this.#desk.planned(id)?.values.reverse });
  }

  side(): void {
    const [id] = this.#desk.chosen;
    if (id === undefined) return;
    const sides = this.#desk.contours.get(id)?.closed ? SIDES : OPEN_SIDES;
    const now = this.#desk.planned(id)?.values.side ?? "auto";
    this.wish({ side: sides[(sides.indexOf(now) + 1) % sides.length] });
  }

  /** Cut so many places earlier or later than it is planned. */
  async order(by: number): Promise<void> {
    await this.#desk.settle();
    const { chosen, plan } = this.#desk;
    const [id] = chosen;
    const number = id === undefined ? undefined : this.#desk.planned(id)?.number;
    if (chosen.length !== 1 || !number) return;
    const wanted = Math.max(1, Math.min(plan.order.length, number + by));
    if (wanted !== number) this.wish({ order: wanted });
  }

  /** Cut in the place of another one. */
  orderBefore(id: number, other: number): void {
    const order = this.#desk.planned(other)?.number;
    const { edited, contours } = this.#desk;
    if (order && id !== other) this.#desk.edit(change(edited, { contours: [id] }, { order }, contours));
  }

  /** All that are alike to the chosen ones are chosen. */
  alike(): void {
    const { contours, chosen } = this.#desk;
    if (chosen.length) this.#desk.choose({ contours: alikeTo(contours, chosen) });
  }

  /** The middle of the chosen contour is 0, 0 on the machine. */
  zero(): void {
    const [id] = this.#desk.chosen;
    const shape = id === undefined ? undefined : this.#desk.shapes.get(id);
    if (!shape) return;
    const [left, bottom, right, top] = shape.box;
    const middle = rounded(millimetres([(left + right) / 2, (bottom + top) / 2]));
    this.#desk.edit(set(this.#desk.edited, "place", "origin", middle));
  }

  reset(): void {
    const { edited, contours, chosen } = this.#desk;
    this.#desk.edit(reset(edited, { contours: chosen }, contours));
  }

  /** The contour that is cut after the chosen one, or before it. */
  next(by: number): void {
    const { plan, chosen, contours } = this.#desk;
    const uncut = [...contours.keys()].filter((id) => !this.#desk.planned(id)?.cut);
    const all = [...plan.order.filter((id) => contours.has(id)), ...uncut];
    if (!all.length) return;
    const now = all.indexOf(chosen[0] ?? -1);
    const next = all[now < 0 ? (by > 0 ? 0 : all.length - 1) : (now + by + all.length) % all.length];
    if (next !== undefined) this.#desk.choose({ contours: [next] });
  }
}
