/** One sentence at the foot of the page until it is put away, and questions that want an answer. */
import { get } from "./dom.ts";
import { t, type Word } from "./language.ts";

export interface Offer {
  label: string;
  take: () => void;
}

export function say(word: Word, ...values: (string | number)[]): void {
  show(t(word, ...values));
}

export function show(text: string, offer?: Offer): void {
  const box = get("message");
  (box.firstElementChild as HTMLElement).textContent = text;
  box.hidden = false;
  const button = get<HTMLButtonElement>("offer");
  button.hidden = !offer;
  button.textContent = offer?.label ?? "";
  button.onclick = () => {
    box.hidden = true;
    offer?.take();
  };
}

export function hide(): void {
  get("message").hidden = true;
}

/** Asks in a window of its own; true for yes. */
export function ask(question: string, yes: string): Promise<boolean> {
  const dialog = get<HTMLDialogElement>("question");
  get("question-text").textContent = question;
  get("question-yes").textContent = yes;
  dialog.returnValue = "";
  dialog.showModal();
  return new Promise((answer) => {
    dialog.onclose = () => answer(dialog.returnValue === "yes");
  });
}
