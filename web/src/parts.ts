/** The part list: all of examples/, with their pictures. parts.json is made of them when the page is built. */
import { CATALOGUE, type Entry, inLanguage } from "./catalogue.ts";
import { make } from "./dom.ts";
import { spoken } from "./language.ts";

export interface Part {
  name: string;
  program: string;
  /** The program as the machine lists it, where that is another text: it prints eight digits. */
  listed?: string;
  /** Path data in a square of 64. */
  picture: string;
}

const SVG = "http://www.w3.org/2000/svg";

export async function readParts(): Promise<Part[]> {
  const answer = await fetch("parts.json");
  if (!answer.ok) throw new Error(`parts.json: ${answer.status}`);
  return (await answer.json()) as Part[];
}

function pictureOf(data: string): SVGElement {
  const picture = document.createElementNS(SVG, "svg");
  picture.setAttribute("viewBox", "0 0 64 64");
  picture.setAttribute("aria-hidden", "true");
  const path = document.createElementNS(SVG, "path");
  path.setAttribute("d", data);
  picture.append(path);
  return picture;
}

function rowOf(entry: Entry, part: Part, open: (part: Part) => void): HTMLElement {
  const row = make("li", "");
  const button = make("button", "");
  button.type = "button";
  button.dataset["part"] = part.name;
  const words = make("span", "words");
  words.append(make("b", "", inLanguage(entry.title, spoken())));
  if (entry.hint) words.append(make("span", "", inLanguage(entry.hint, spoken())));
  button.append(pictureOf(part.picture), words);
  button.addEventListener("click", () => open(part));
  row.append(button);
  return row;
}

/** Fills the list, in the present language; `open` is called with the part of a button. */
export function showParts(box: HTMLElement, parts: readonly Part[], open: (part: Part) => void): void {
  const marked = box.querySelector<HTMLElement>("[aria-current]")?.dataset["part"];
  const byName = new Map(parts.map((part) => [part.name, part]));
  box.replaceChildren(
    ...CATALOGUE.map((group, at) => {
      const list = make("ul", "");
      const heading = make("h3", "", inLanguage(group.title, spoken()));
      heading.id = `group-${at}`;
      list.setAttribute("aria-labelledby", heading.id);
      for (const entry of group.parts) {
        const part = byName.get(entry.name);
        if (part) list.append(rowOf(entry, part, open));
      }
      const section = make("div", "group");
      section.append(heading, list);
      return section;
    }),
  );
  markPart(box, marked);
}

/** Shows which one is open. */
export function markPart(box: HTMLElement, name: string | undefined): void {
  for (const button of box.querySelectorAll<HTMLElement>("[data-part]")) {
    button.ariaCurrent = button.dataset["part"] === name ? "true" : null;
  }
}
