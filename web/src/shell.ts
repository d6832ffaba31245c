/** The frame of a page: views, menus, the message and the question. */
import { get, onClick } from "./dom.ts";
import { dismiss } from "./message.ts";
import { closePane } from "./pane.ts";

/** One section is seen at a time. */
const SMALL = "(max-width: 1050px)";

/** Is it a small screen? */
export const isSmall = (): boolean => matchMedia(SMALL).matches;

export function view(name: string): void {
  document.body.dataset["view"] = name;
  for (const button of document.querySelectorAll<HTMLElement>("#views [data-view]")) {
    button.ariaCurrent = button.dataset["view"] === name ? "true" : null;
  }
}

export function bindShell(): void {
  onClick("dismiss", dismiss);
  onClick("question-yes", () => get<HTMLDialogElement>("question").close("yes"));
  onClick("question-no", () => get<HTMLDialogElement>("question").close(""));
  for (const button of document.querySelectorAll<HTMLElement>("#views [data-view]")) {
    button.addEventListener("click", () => {
      closePane();
      view(button.dataset["view"] ?? "");
    });
  }
  bindMenus();
}

/** A menu closes when something else is pressed, and by Escape. */
function bindMenus(): void {
  for (const menu of document.querySelectorAll<HTMLDetailsElement>("details.menu")) {
    menu.addEventListener("keydown", (event) => {
      if (event.key !== "Escape") return;
      menu.open = false;
      menu.querySelector("summary")?.focus();
    });
    menu.addEventListener("click", (event) => {
      if ((event.target as HTMLElement).closest("button")) menu.open = false;
    });
  }
  addEventListener("pointerdown", (event) => {
    for (const menu of document.querySelectorAll<HTMLDetailsElement>("details.menu[open]")) {
      if (!menu.contains(event.target as Node)) menu.open = false;
    }
  });
}
