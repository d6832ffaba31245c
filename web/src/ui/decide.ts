/** The line above the drawing: what wants a decision, one after the other, with what can be done about it. */
import { get, make, onClick } from "../dom.ts";
import { inPresent } from "../language.ts";
import { view } from "../shell.ts";
import type { Canvas } from "./canvas.ts";
import type { Desk } from "./desk.ts";
import { type Fix, fixesOf } from "./fixes.ts";
import { micrometres } from "./geometry.ts";
import type { TellTale, Told } from "./told.ts";
import type { Point } from "./types.ts";
import { w } from "./words.ts";

export class Decisions {
  readonly #desk: Desk;
  readonly #canvas: Canvas;
  readonly #told: TellTale;
  /** The one that is shown, and how it is known again when others have come or gone. */
  #at = 0;
  #present = "";
  #isWrong = false;
  #shown = "";

  constructor(desk: Desk, canvas: Canvas, told: TellTale) {
    this.#desk = desk;
    this.#canvas = canvas;
    this.#told = told;
    onClick("decide-before", () => this.#turn(-1));
    onClick("decide-next", () => this.#turn(1));
  }

  #turn(by: number): void {
    const { length } = this.#told.open;
    this.#at = (this.#at + by + length) % Math.max(1, length);
    this.#present = "";
    this.show();
    const line = this.#told.open[this.#at];
    if (line) this.look(line);
  }

  show(): void {
    const open = this.#told.open;
    const same = open.findIndex((line) => nameOf(line) === this.#present);
    this.#at = same >= 0 ? same : Math.min(this.#at, Math.max(0, open.length - 1));
    // (what keeps the tape from being made is looked at when it comes)
    const isWrong = open.some((each) => each.wrong);
    if (isWrong && !this.#isWrong) this.#at = open.findIndex((each) => each.wrong);
    this.#isWrong = isWrong;
    const line = open[this.#at];
    this.#present = line ? nameOf(line) : "";
    this.#ring([]);
    const box = get("decide");
    box.hidden = !line;
    const { drawn } = this.#desk.state ?? {};
    const shown = JSON.stringify([line, this.#at, open.length, drawn, document.documentElement.lang]);
    if (!line || shown === this.#shown) return;
    this.#shown = shown;
    box.className = line.wrong ? "wrong" : "care";
    get("decide-text").textContent = get("decide-text").title = inPresent(line.text);
    get("decide-count").textContent = w("decideCount", this.#at + 1, open.length);
    get("decide-turn").hidden = open.length < 2;
    get("decide-fixes").replaceChildren(...this.#fixes(line).map((fix) => this.#button(fix)));
  }

  /** Rings the places that want a decision, and those that a button is about. */
  #ring(meant: readonly Point[]): void {
    const rings = this.#told.open.flatMap((each, at) => {
      const place = this.#placeOf(each);
      return place ? [{ place: micrometres(place), isWrong: each.wrong === true, isPresent: at === this.#at }] : [];
    });
    this.#canvas.rings = [...rings, ...meant.map((place) => ({ place: micrometres(place), isWrong: false, isPresent: true }))];
  }

  #button({ label, name, act, places }: Fix): HTMLButtonElement {
    const made = make("button", "", label);
    if (name) made.title = made.ariaLabel = name;
    made.type = "button";
    made.addEventListener("click", act);
    if (places) {
      for (const event of ["pointerenter", "focus"]) made.addEventListener(event, () => this.#ring(places));
      for (const event of ["pointerleave", "blur"]) made.addEventListener(event, () => this.#ring([]));
    }
    return made;
  }

  #fixes(line: Told): Fix[] {
    const { offer } = line;
    if (offer !== undefined) {
      return [
        { label: w("offerTake"), act: () => void this.#desk.take(offer, true) },
        { label: w("offerLeave"), act: () => void this.#desk.take(offer, false) },
      ];
    }
    const fixes = fixesOf(this.#desk, line);
    if (this.#placeOf(line)) fixes.unshift({ label: w("show"), act: () => this.look(line) });
    if (!line.wrong) fixes.push({ label: w("fixAsItIs"), act: () => this.#told.accept(line) });
    return fixes;
  }

  #placeOf({ place, contour }: Told): Point | undefined {
    return place ?? (contour === null || contour === undefined ? undefined : this.#desk.contours.get(contour)?.at);
  }

  /** Brings the place of a line into sight, and chooses its contour. */
  look(line: Told): void {
    const { contour } = line;
    view("drawing");
    if (contour !== null && contour !== undefined) this.#desk.choose({ contours: [contour] });
    this.#canvas.point(this.#placeOf(line));
  }
}

const nameOf = ({ code, contour, place, offer }: Told): string => JSON.stringify([code, contour, place, offer]);
