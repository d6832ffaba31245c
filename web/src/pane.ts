/** The pane beside the page, with one thing at a time: the manual, the machine's inside. */
import { get } from "./dom.ts";

let whenClosed: (() => void) | undefined;

/** `closed` is called when it is closed, or another one takes its place. */
export function openPane(id: string, closed?: () => void): void {
  if (get(id).hidden) closePane();
  document.body.classList.add("reading");
  get(id).hidden = false;
  whenClosed = closed;
}

export function closePane(): void {
  const closed = whenClosed;
  whenClosed = undefined;
  document.body.classList.remove("reading");
  for (const pane of document.querySelectorAll<HTMLElement>(".pane")) pane.hidden = true;
  closed?.();
}
