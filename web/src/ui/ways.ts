/** The wire's ways beside the contours in view, as the planner has them: asked of the server when they are wanted. */
import type { Desk } from "./desk.ts";
import { edgesOf } from "./geometry.ts";
import { Gone, Refusal, type Server } from "./server.ts";

/** So many contours' ways are asked for at most: each takes the server some milliseconds. */
export const MOST = 200;

type Way = readonly (readonly number[])[];

export class WireWays {
  readonly #desk: Desk;
  readonly #server: Server;
  readonly #known = new Map<number, { of: string; ways: readonly Way[] }>();
  readonly #come: () => void;
  #isAsking = false;

  /** `come`: called when more of them have come. */
  constructor(desk: Desk, server: Server, come: () => void) {
    this.#desk = desk;
    this.#server = server;
    this.#come = come;
  }

  /** The wire's ways along a contour, µm; undefined: not known yet for the present plan. */
  of(id: number): readonly Way[] | undefined {
    const known = this.#known.get(id);
    return known && known.of === this.#plan(id) ? known.ways : undefined;
  }

  /** The wire does not get around it. */
  hasNoRoom(id: number): boolean {
    return this.of(id)?.length === 0;
  }

  /** All contours that the wire is known not to get around. */
  get withoutRoom(): number[] {
    return [...this.#known.keys()].filter((id) => this.#desk.planned(id)?.cut && this.hasNoRoom(id));
  }

  #plan(id: number): string {
    return JSON.stringify(this.#desk.planned(id) ?? null);
  }

  forget(): void {
    this.#known.clear();
  }

  /** Asks for those that are not known, unless they are too many. */
  async want(ids: readonly number[]): Promise<void> {
    if (ids.length > MOST || this.#isAsking || !this.#desk.isSettled) return;
    const missing = ids.filter((id) => this.#desk.planned(id)?.cut && !this.of(id));
    if (!missing.length) return;
    this.#isAsking = true;
    const plans = new Map(missing.map((id) => [id, this.#plan(id)]));
    try {
      const ways = await this.#server.ways(this.#desk.rev, missing);
      for (const id of missing) {
        const found = (ways[String(id)] ?? []).map(edgesOf);
        this.#known.set(id, { of: plans.get(id) as string, ways: found });
      }
    } catch (error) {
      // (another plan has come meanwhile, or nobody answers: the picture asks again when it is drawn)
      if (!(error instanceof Refusal || error instanceof Gone)) throw error;
      return;
    } finally {
      this.#isAsking = false;
    }
    this.#come();
  }
}
