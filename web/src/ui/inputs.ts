/** Fields of a form: numbers, lists of numbers, texts, choices, switches; each with what it holds itself in bold, what it
 * inherits in grey, and a way back to that. */
import { make } from "../dom.ts";
import { shown, typed, typedList } from "./look.ts";
import { find, type Word, w } from "./words.ts";

export type Value = number | string | boolean | readonly number[] | undefined;

/** The description of a field. `options`: values and their words; `at`: a point's x or y. */
export interface Plan {
  readonly key: string;
  readonly label: Word;
  readonly kind: "number" | "list" | "text" | "choice" | "switch" | "point" | "whole";
  readonly options?: readonly (readonly [string, Word | ""])[];
  readonly unit?: string;
  readonly example?: string;
}

export class Field {
  readonly row = make("div", "field");
  readonly plan: Plan;
  readonly #inputs: (HTMLInputElement | HTMLSelectElement)[] = [];
  readonly #label: HTMLElement;
  readonly #back: HTMLButtonElement | undefined;
  #shown: Value;

  /** `take`: the field's new value, undefined: inherit it again; `wrong`: what was typed cannot be read. */
  constructor(plan: Plan, take: (value: Value) => void, wrong: (message: string) => void, canInherit: boolean) {
    this.plan = plan;
    this.#label = make(plan.kind === "point" ? "span" : "label", "label");
    const inputs = plan.kind === "point" ? [this.#input("x"), this.#input("y")] : [this.#input("")];
    if (this.#label instanceof HTMLLabelElement) this.#label.htmlFor = (inputs[0] as HTMLElement).id;
    for (const input of inputs) {
      input.addEventListener("change", () => {
        const value = this.#read();
        for (const each of inputs) each.ariaInvalid = String(value === null);
        if (value === null) wrong(w("badNumber", w(plan.label), plan.example ?? "0.5"));
        else take(value);
      });
    }
    this.row.append(this.#label, ...inputs);
    this.row.append(make("span", "unit", plan.unit ?? ""));
    if (!canInherit) return;
    const back = make("button", "back", "↺");
    back.type = "button";
    back.addEventListener("click", () => {
      take(undefined);
      inputs[0]?.focus();
    });
    this.row.append(back);
    this.#back = back;
  }

  #input(part: string): HTMLInputElement | HTMLSelectElement {
    const { kind, key, options } = this.plan;
    const input = kind === "choice" ? make("select", "") : make("input", "");
    input.id = `field-${key}${part && `-${part}`}`;
    if (input instanceof HTMLSelectElement) {
      for (const [value, word] of options ?? []) {
        const option = make("option", "", word ? "" : value);
        option.value = value;
        if (word) option.dataset["t"] = word;
        input.append(option);
      }
    } else if (kind === "switch") {
      input.type = "checkbox";
    } else {
      input.type = "text";
      input.autocomplete = "off";
      input.spellcheck = false;
      if (kind !== "text") input.inputMode = kind === "list" ? "text" : "decimal";
    }
    this.#inputs.push(input);
    return input;
  }

  /** The field's value; null: it cannot be read. */
  #read(): Value | null {
    const [first, second] = this.#inputs;
    if (!first) return undefined;
    switch (this.plan.kind) {
      case "switch":
        return (first as HTMLInputElement).checked;
      case "choice":
      case "text":
        return first.value.trim() || undefined;
      case "list":
        return typedList(first.value);
      case "point": {
        const [x, y] = [typed(first.value), typed(second?.value ?? "")];
        if (x === undefined && y === undefined) return undefined;
        return typeof x === "number" && typeof y === "number" ? [x, y] : null;
      }
      default: {
        const value = typed(first.value);
        return this.plan.kind === "whole" && typeof value === "number" && !Number.isInteger(value) ? null : value;
      }
    }
  }

  /** Shows a value; undefined: several that differ, or none. What is being typed is left alone. */
  show(value: Value, isOwn: boolean, isMixed = false): void {
    this.row.classList.toggle("own", isOwn);
    if (this.#back) this.#back.style.visibility = isOwn ? "" : "hidden";
    const isTyping = this.#inputs.some(
      (input) => input === document.activeElement && input.value !== this.#texts()[this.#inputs.indexOf(input)],
    );
    if (isTyping && same(value, this.#shown)) return;
    this.#shown = value;
    const texts = this.#texts();
    this.#inputs.forEach((input, at) => {
      if (input instanceof HTMLInputElement && input.type === "checkbox") {
        input.checked = value === true;
        input.indeterminate = isMixed;
        return;
      }
      input.value = texts[at] ?? "";
      input.ariaInvalid = "false";
      if (input instanceof HTMLInputElement) input.placeholder = isMixed ? w("mixed") : "";
    });
  }

  #texts(): string[] {
    const value = this.#shown;
    if (this.plan.kind === "point") return Array.isArray(value) ? value.map(shown) : ["", ""];
    if (Array.isArray(value)) return [value.map(shown).join(", ")];
    return [typeof value === "number" ? shown(value) : value === undefined ? "" : String(value)];
  }

  /** In the present language. */
  name(): void {
    const word = w(this.plan.label);
    this.#label.textContent = word;
    this.row.title = this.plan.unit ? w("withUnit", word, this.plan.unit) : word;
    if (this.plan.kind === "point") {
      this.#inputs.forEach((input, at) => {
        input.ariaLabel = w(at ? "ofY" : "ofX", word);
      });
    }
    for (const option of this.row.querySelectorAll("option")) {
      const text = find(option.dataset["t"] ?? "");
      if (text) option.textContent = text;
    }
    if (!this.#back) return;
    this.#back.ariaLabel = w("inherit", word);
    this.#back.title = w("inherit", word);
  }

  focus(): void {
    this.#inputs[0]?.focus();
  }
}

export const same = (one: unknown, two: unknown): boolean => JSON.stringify(one) === JSON.stringify(two);
