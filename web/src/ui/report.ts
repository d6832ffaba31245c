/** The lines of the report: of the reading, the plan and the cut; a place or contour of theirs can be looked at. */
import { get, make } from "../dom.ts";
import { view } from "../shell.ts";
import type { Canvas } from "./canvas.ts";
import type { Cutting } from "./cutting.ts";
import type { Desk } from "./desk.ts";
import type { Fault, Line, Plan } from "./types.ts";
import { w } from "./words.ts";

interface Told extends Line {
  readonly wrong?: boolean;
}

export class Report {
  readonly #desk: Desk;
  readonly #cutting: Cutting;
  readonly #canvas: Canvas;
  #told = "";
  /** Errors of single contours of a plan, kept for `#plan`: there may be many. */
  #plan: Plan | undefined;
  #each: Told[] = [];

  constructor(desk: Desk, cutting: Cutting, canvas: Canvas) {
    this.#desk = desk;
    this.#cutting = cutting;
    this.#canvas = canvas;
  }

  /** A cut's lines hold the reading's and the plan's. */
  #lines(): Told[] {
    const { state, plan } = this.#desk;
    const { outcome, isOld } = this.#cutting;
    if (!state) return [];
    if (outcome.kind === "done" && !isOld) return [...outcome.result.lines];
    const failed: Told[] = outcome.kind === "failed" && !isOld ? [fault(outcome.fault)] : [];
    const faults = [state.error, plan.error].flatMap((each) => (each ? [fault(each)] : []));
    if (plan !== this.#plan) {
      this.#plan = plan;
      this.#each = Object.entries(plan.contours)
        .filter(([id, { error }]) => error && Number(id) !== plan.error?.contour)
        .map(([id, { error }]) => fault({ message: error ?? "", contour: Number(id) }));
    }
    const known = new Set<string>();
    return [...failed, ...faults, ...this.#each, ...state.report, ...plan.said].filter(({ text }) => {
      const isNew = !known.has(text);
      known.add(text);
      return isNew;
    });
  }

  show(): void {
    const lines = this.#lines();
    const told = JSON.stringify([lines, document.documentElement.lang]);
    if (told === this.#told) return;
    this.#told = told;
    const list = make("ul", "lines");
    for (const line of lines) list.append(this.#line(line));
    get("report").replaceChildren(list);
  }

  #line({ text, care, wrong, contour, place }: Told): HTMLElement {
    const row = make("li", wrong ? "wrong" : care ? "care" : "");
    if (care) row.append(make("b", "mark", w("care")));
    row.append(make("span", "", text));
    const id = contour ?? undefined;
    const spot = place ?? (id === undefined ? undefined : this.#desk.contours.get(id)?.at);
    if (!spot) return row;
    const button = make("button", "link", w("show"));
    button.type = "button";
    button.addEventListener("click", () => {
      view("drawing");
      if (id !== undefined) this.#desk.choose({ contours: [id] });
      this.#canvas.point(place ?? undefined);
      if (!place) this.#canvas.bringIn();
    });
    row.append(button);
    return row;
  }
}

const fault = ({ message, contour, place }: Fault): Told => ({ text: message, wrong: true, contour, place });
