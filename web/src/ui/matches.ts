/** Contours that were not found again in a drawing that was saved anew, and those that want to be confirmed. */
import { get, make } from "../dom.ts";
import type { Desk } from "./desk.ts";
import { forget } from "./edits.ts";
import { shown } from "./look.ts";
import { kindWord } from "./treerow.ts";
import type { Chosen } from "./types.ts";
import { w } from "./words.ts";

export class MatchList {
  readonly #desk: Desk;
  readonly #confirmed = new Set<number>();

  constructor(desk: Desk) {
    this.#desk = desk;
    desk.onChange((news) => {
      if (news.has("drawing")) this.#confirmed.clear();
      if (news.has("drawing") || news.has("job")) this.show();
    });
  }

  show(): void {
    const { state, edited } = this.#desk;
    const rows: HTMLElement[] = [];
    edited.ids.forEach((id, index) => {
      const chosen = edited.job.contour?.[index];
      if (chosen && id === null) {
        rows.push(row("lost", w("lost", nameOf(chosen)), w("forget"), () => this.#desk.edit(forget(this.#desk.edited, index))));
      }
    });
    for (const { id, moved, confirm } of state?.matches ?? []) {
      const chosen = id === null ? undefined : edited.job.contour?.[edited.ids.indexOf(id)];
      if (id === null || !confirm || !chosen || this.#confirmed.has(id)) continue;
      const text = w("moved", nameOf(chosen), shown(moved));
      const line = row("doubt", text, w("confirm"), () => {
        this.#confirmed.add(id);
        this.show();
      });
      line.querySelector("span")?.addEventListener("click", () => this.#desk.choose({ contours: [id] }));
      rows.push(line);
    }
    get("matches").replaceChildren(...rows);
  }
}

const nameOf = ({ layer, kind, size, at }: Chosen): string =>
  `${layer} ${kindWord(kind)} ${size.map(shown).join(" × ")} (${at.map(shown).join(", ")})`;

function row(name: string, text: string, label: string, act: () => void): HTMLElement {
  const line = make("li", name);
  const button = make("button", "", label);
  button.type = "button";
  button.addEventListener("click", act);
  line.append(make("span", "", text), button);
  return line;
}
