/** Elements of the page. */

export function get<T extends HTMLElement>(id: string): T {
  const found = document.getElementById(id);
  if (!found) throw new Error(`no #${id}`);
  return found as T;
}

export function onClick(id: string, action: () => void): void {
  get(id).addEventListener("click", action);
}

/** A new element with a class and a text. */
export function make<K extends keyof HTMLElementTagNameMap>(tag: K, name: string, text = ""): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  if (name) element.className = name;
  element.textContent = text;
  return element;
}

/** Writes what an element says; the same once more is no change, or a screen reader would read it again. */
export function tell(element: Element, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}
