/** The menu of a contour: by the other button, a finger that stays, or the menu key. */
import { get, make } from "../dom.ts";
import type { Actions } from "./actions.ts";
import { alikeTo } from "./alike.ts";
import type { Desk } from "./desk.ts";
import { isCut } from "./edits.ts";
import { titleOf } from "./treerow.ts";
import { w } from "./words.ts";

/** The tab that the menu gives, mm. */
const TAB = 1.5;

export class Menu {
  readonly #desk: Desk;
  readonly #actions: Actions;
  #last: HTMLElement | undefined;

  constructor(desk: Desk, actions: Actions) {
    this.#desk = desk;
    this.#actions = actions;
    const box = get("menu");
    box.addEventListener("keydown", (event) => this.#key(event));
    addEventListener("pointerdown", (event) => {
      if (!box.contains(event.target as Node)) this.#close(false);
    });
  }

  /** Opens it at a place of the window. */
  open(id: number, x: number, y: number): void {
    const contour = this.#desk.contours.get(id);
    if (!contour) return;
    const box = get("menu");
    const actions = this.#actions;
    const cut = isCut(this.#desk.edited, contour);
    const tab = this.#desk.planned(id)?.values.tab;
    const { chosen, contours } = this.#desk;
    const count = alikeTo(contours, chosen).length;
    const items: [string, () => void][] = [
      [w(cut ? "skipCut" : "doCut"), () => actions.skip()],
      ...(cut
        ? ([
            [w("side"), () => actions.side()],
            [w("reverse"), () => actions.reverse()],
            [tab ? w("noTab") : w("addTab", TAB), () => actions.wish({ tab: tab ? 0 : TAB })],
            [w("earlier"), () => void actions.order(-1)],
            [w("later"), () => void actions.order(1)],
          ] as [string, () => void][])
        : []),
      ...(count > chosen.length ? ([[w("alike", count), () => actions.alike()]] as [string, () => void][]) : []),
      ...(contour.closed ? ([[w("zeroHere"), () => actions.zero()]] as [string, () => void][]) : []),
      [w("resetToLayer"), () => actions.reset()],
    ];
    box.ariaLabel = w("menuOf", titleOf(contour));
    box.replaceChildren(
      ...items.map(([text, act]) => {
        const item = make("button", "", text);
        item.type = "button";
        item.role = "menuitem";
        item.addEventListener("click", () => {
          this.#close(true);
          act();
        });
        return item;
      }),
    );
    this.#last = document.activeElement instanceof HTMLElement ? document.activeElement : undefined;
    box.hidden = false;
    box.style.left = `${Math.max(4, Math.min(x, innerWidth - box.offsetWidth - 4))}px`;
    box.style.top = `${Math.max(4, Math.min(y, innerHeight - box.offsetHeight - 4))}px`;
    (box.firstElementChild as HTMLElement).focus();
  }

  #close(isBack: boolean): void {
    get("menu").hidden = true;
    if (isBack) this.#last?.focus();
  }

  #key(event: KeyboardEvent): void {
    const items = [...get("menu").children] as HTMLElement[];
    const at = items.indexOf(document.activeElement as HTMLElement);
    const goal = { ArrowDown: at + 1, ArrowUp: at - 1, Home: 0, End: items.length - 1 }[event.key];
    event.stopPropagation();
    if (event.key === "Escape" || event.key === "Tab") this.#close(true);
    else if (goal !== undefined) items[(goal + items.length) % items.length]?.focus();
    else return;
    event.preventDefault();
  }
}
