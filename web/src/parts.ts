/** The part list: all of examples/, with their pictures. parts.json is made of them when the page is built. */

export interface Part {
  name: string;
  /** From the program's first REM. */
  title: string;
  program: string;
  /** Path data in a square of 64. */
  picture: string;
}

const SVG = "http://www.w3.org/2000/svg";

export async function readParts(): Promise<Part[]> {
  const answer = await fetch("parts.json");
  if (!answer.ok) throw new Error(`parts.json: ${answer.status}`);
  return (await answer.json()) as Part[];
}

/** Fills the list; `open` is called with the part of a button. */
export function showParts(box: HTMLElement, parts: readonly Part[], open: (part: Part) => void): void {
  box.replaceChildren(...parts.map((part) => {
    const row = document.createElement("li");
    const button = document.createElement("button");
    button.type = "button";
    button.dataset["part"] = part.name;
    const picture = document.createElementNS(SVG, "svg");
    picture.setAttribute("viewBox", "0 0 64 64");
    picture.setAttribute("aria-hidden", "true");
    const path = document.createElementNS(SVG, "path");
    path.setAttribute("d", part.picture);
    picture.append(path);
    const name = document.createElement("b");
    name.textContent = part.name;
    const title = document.createElement("span");
    title.textContent = part.title;
    const words = document.createElement("span");
    words.className = "words";
    words.append(name, title);
    button.append(picture, words);
    button.addEventListener("click", () => open(part));
    row.append(button);
    return row;
  }));
}

/** Shows which one is open. */
export function markPart(box: HTMLElement, name: string | undefined): void {
  for (const button of box.querySelectorAll<HTMLElement>("[data-part]")) {
    button.ariaCurrent = button.dataset["part"] === name ? "true" : null;
  }
}
