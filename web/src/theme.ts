/** Light or dark, as chosen or as the system has it. */
import type { Theme } from "./store.ts";

const system = globalThis.matchMedia?.("(prefers-color-scheme: dark)");

export const onSystemTheme = (changed: () => void): void => system?.addEventListener("change", changed);

/** Puts a page inside the page, the manual, into its colours. */
export function paintFrame(frame: HTMLIFrameElement): void {
  const inside = frame.contentDocument?.documentElement;
  if (inside) inside.dataset["theme"] = document.documentElement.dataset["theme"] ?? "";
}

/** Puts the page into its colours; returns the value of a colour of base.css by its name. */
export function paint(theme: Theme): (name: string) => string {
  const isDark = theme === "dark" || (theme === "auto" && system?.matches);
  document.documentElement.dataset["theme"] = isDark ? "dark" : "light";
  for (const frame of document.querySelectorAll("iframe")) paintFrame(frame);
  const style = getComputedStyle(document.documentElement);
  return (name) => style.getPropertyValue(`--${name}`).trim();
}
