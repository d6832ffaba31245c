/** Numbers of a program that it says may be set: a line `REM SET what: least TO most STEP s` before `name=number`. */
import { make } from "./dom.ts";

export interface Parameter {
  label: string;
  /** The number's place in the text. */
  from: number;
  to: number;
  value: number;
  least: number;
  most: number;
  step: number;
}

const SET =
  /^[ \t]*\d+[ \t]*REM[ \t]+SET[ \t]+(.+?):[ \t]*(-?[\d.]+)[ \t]+TO[ \t]+(-?[\d.]+)(?:[ \t]+STEP[ \t]+([\d.]+))?[ \t]*$/i;
const VALUE = /^([ \t]*\d+[ \t]*[A-Z]\d*[ \t]*=[ \t]*)(-?(?:\d+\.?\d*|\.\d+))[ \t]*$/i;

export function parametersOf(text: string): Parameter[] {
  const found: Parameter[] = [];
  let at = 0;
  let before: RegExpExecArray | null = null;
  for (const line of text.split("\n")) {
    const value = before && VALUE.exec(line);
    const [label = "", least, most, step] = before?.slice(1) ?? [];
    if (value) {
      const from = at + (value[1] ?? "").length;
      const number = value[2] ?? "";
      found.push({
        label,
        from,
        to: from + number.length,
        value: Number(number),
        least: Number(least),
        most: Number(most),
        step: Number(step ?? 0) || (Number(most) - Number(least)) / 100,
      });
    }
    before = SET.exec(line);
    at += line.length + 1;
  }
  return found.filter(({ least, most }) => least < most);
}

/** The text with another value in a parameter's place. */
export const withValue = (text: string, { from, to }: Parameter, value: string): string =>
  text.slice(0, from) + value + text.slice(to);

/** Fills the box with a slider and a field for each; what is there stays while only values change. */
export function showParameters(
  box: HTMLElement,
  parameters: readonly Parameter[],
  set: (at: number, value: string) => void,
): void {
  const labels = parameters.map(({ label, least, most, step }) => [label, least, most, step].join()).join("\n");
  box.hidden = !parameters.length;
  if (box.dataset["labels"] !== labels) {
    box.dataset["labels"] = labels;
    box.replaceChildren(
      ...parameters.flatMap(({ label, least, most, step }, at) => {
        const inputs = (["range", "number"] as const).map((type) => {
          const input = make("input", "");
          Object.assign(input, { type, min: String(least), max: String(most), step: String(step) });
          input.ariaLabel = label;
          input.addEventListener("input", () => {
            if (input.value !== "" && input.validity.valid) set(at, input.value);
          });
          return input;
        });
        return [make("span", "", label), ...inputs];
      }),
    );
  }
  for (const [at, { value }] of parameters.entries()) {
    for (const input of [box.children[3 * at + 1], box.children[3 * at + 2]] as HTMLInputElement[]) {
      if (input !== document.activeElement || Number(input.value) !== value) input.value = String(value);
    }
  }
}
