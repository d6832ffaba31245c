/** The lines of the report; a place or contour of theirs can be looked at. */
import { get, make } from "../dom.ts";
import { inPresent } from "../language.ts";
import type { Desk } from "./desk.ts";
import type { TellTale, Told } from "./told.ts";
import { w } from "./words.ts";

export class Report {
  readonly #desk: Desk;
  readonly #told: TellTale;
  readonly #look: (line: Told) => void;
  #shown = "";

  /** `look`: brings the place of a line into sight. */
  constructor(desk: Desk, told: TellTale, look: (line: Told) => void) {
    this.#desk = desk;
    this.#told = told;
    this.#look = look;
  }

  show(): void {
    const { lines } = this.#told;
    const shown = JSON.stringify([lines, document.documentElement.lang]);
    if (shown === this.#shown) return;
    this.#shown = shown;
    const list = make("ul", "lines");
    for (const line of lines) list.append(this.#line(line));
    get("report").replaceChildren(list);
  }

  #line(line: Told): HTMLElement {
    const { text, care, wrong, contour, place } = line;
    const row = make("li", wrong ? "wrong" : care ? "care" : "");
    if (care) row.append(make("b", "mark", w("care")));
    row.append(make("span", "", inPresent(text)));
    if (!place && !this.#desk.contours.has(contour ?? -1)) return row;
    const button = make("button", "link", w("show"));
    button.type = "button";
    button.addEventListener("click", () => this.#look(line));
    row.append(button);
    return row;
  }
}
