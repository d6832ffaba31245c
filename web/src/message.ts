/** One sentence at the foot of the page until it is put away, and questions that want an answer. */
import { get } from "./dom.ts";
import { t, type Word } from "./language.ts";

export interface Offer {
  label: string;
  take: () => void;
}

/** Messages that stay until they are put away: others cover them for a while. */
let lasting: { text: string; offer: Offer | undefined }[] = [];

export function say(word: Word, ...values: (string | number)[]): void {
  show(t(word, ...values));
}

/** Says something that is not hidden by what is done next: what is at stake is the visitor's work. */
export function warn(text: string, offer?: Offer): void {
  lasting = [...lasting.filter((each) => each.text !== text), { text, offer }];
  show(text, offer);
}

export function show(text: string, offer?: Offer): void {
  const box = get("message");
  (box.firstElementChild as HTMLElement).textContent = text;
  box.hidden = false;
  const button = get<HTMLButtonElement>("offer");
  button.hidden = !offer;
  button.textContent = offer?.label ?? "";
  button.onclick = () => {
    dismiss();
    offer?.take();
  };
}

/** The visitor has read what is said. */
export function dismiss(): void {
  const text = get("message").firstElementChild?.textContent;
  lasting = lasting.filter((each) => each.text !== text);
  hide();
}

export function hide(): void {
  const last = lasting.at(-1);
  if (last) show(last.text, last.offer);
  else get("message").hidden = true;
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
