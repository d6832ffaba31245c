/** What is told of the job: the reading's lines, the plan's, the cut's; and which of them want a decision. */
import type { Cutting } from "./cutting.ts";
import type { Desk } from "./desk.ts";
import { shown } from "./look.ts";
import type { Fault, Line, Plan } from "./types.ts";
import type { WireWays } from "./ways.ts";
import { both } from "./words.ts";

export interface Told extends Line {
  /** No tape is made while this stands. */
  readonly wrong?: boolean;
  /** A job file that is offered, by its name. */
  readonly offer?: string;
}

export class TellTale {
  readonly #desk: Desk;
  readonly #cutting: Cutting;
  readonly #ways: WireWays;
  /** Errors of single contours of a plan, kept for `#plan`: there may be many. */
  #plan: Plan | undefined;
  #each: Told[] = [];
  /** What somebody has decided to leave as it is. */
  readonly #accepted = new Set<string>();

  constructor(desk: Desk, cutting: Cutting, ways: WireWays) {
    this.#desk = desk;
    this.#cutting = cutting;
    this.#ways = ways;
  }

  /** All lines, each once; a cut's hold the reading's and the plan's. */
  get lines(): readonly Told[] {
    const { state, plan } = this.#desk;
    const { outcome, isOld } = this.#cutting;
    if (!state) return [];
    if (outcome.kind === "done" && !isOld) return [...this.#fileFault(), ...outcome.result.lines];
    const failed: Told[] = outcome.kind === "failed" && !isOld ? [wrong(outcome.fault)] : [];
    const faults = plan.error ? [wrong(plan.error)] : [];
    if (plan !== this.#plan) {
      this.#plan = plan;
      this.#each = Object.entries(plan.contours)
        .filter(([id, { error }]) => error && Number(id) !== plan.error?.contour)
        .map(([, { error }]) => wrong(error as Fault));
    }
    const known = new Set<string>();
    return [...failed, ...this.#fileFault(), ...faults, ...this.#each, ...this.#noRoom(), ...state.report, ...plan.said].filter(
      ({ text: [text] }) => {
        const isNew = !known.has(text);
        known.add(text);
        return isNew;
      },
    );
  }

  /** Those that want a decision: errors first. */
  get open(): readonly Told[] {
    const { lines } = this;
    const isOpen = (line: Told): boolean => line.care === true && !this.#accepted.has(this.#key(line));
    return [...this.#offers(), ...lines.filter((line) => line.wrong), ...lines.filter(isOpen)];
  }

  /** It stays as it is: nobody is asked again while it says the same. */
  accept(line: Told): void {
    this.#accepted.add(this.#key(line));
    this.#cutting.onChange();
  }

  /** Takes a line of this code as decided on, for the drawing that is open. */
  acceptAll(code: string): void {
    this.#accepted.add(`${this.#desk.state?.name} ${code}`);
  }

  hasAccepted(code: string): boolean {
    return this.#accepted.has(`${this.#desk.state?.name} ${code}`);
  }

  #key({ code, key }: Told): string {
    const all = `${this.#desk.state?.name} ${code}`;
    return this.#accepted.has(all) ? all : `${all} ${key}`;
  }

  /** Jobs that lie beside the drawing. */
  #offers(): Told[] {
    return (this.#desk.state?.offers ?? []).map((offer) => ({
      code: "offer",
      text: both(/\.unsaved(-\d+)?\.job\.toml$/.test(offer) ? "offerKept" : "offerJob", offer),
      offer,
    }));
  }

  /** The drawing cannot be read, or its file is gone. */
  #fileFault(): Told[] {
    const { error } = this.#desk.state ?? {};
    return error ? [wrong(error)] : [];
  }

  /** Contours that the wire does not get around, as far as somebody has asked for its ways; those that are too small may
   * be left. */
  #noRoom(): Told[] {
    if (this.#desk.edited.job.machine?.["small"] === "leave") return [];
    const advice: Told["advice"] = [
      ["offset", null],
      ["small", "leave"],
    ];
    return this.#ways.withoutRoom.flatMap((contour) => {
      const planned = this.#desk.planned(contour);
      const { at } = this.#desk.contours.get(contour) ?? {};
      if (!at || planned?.error) return [];
      const text = both("noWay", shown(planned?.number ?? contour + 1), at.map(shown).join(", "));
      return [{ code: "no-way-of-wire", text, wrong: true, contour, advice }];
    });
  }
}

const wrong = ({ message, ...facts }: Fault): Told => ({ ...facts, text: message, wrong: true });
