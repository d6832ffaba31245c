/** Numbers as text and back, and the kind of pointer. */
const coarse = globalThis.matchMedia?.("(pointer: coarse)");

/** The pointer is a finger: its targets are 44 pixels large. */
export const isCoarse = (): boolean => coarse?.matches ?? false;
export const onCoarse = (changed: () => void): void => coarse?.addEventListener("change", changed);

/** A length with no more than three decimals. */
export const shown = (value: number): string => String(Number(value.toFixed(3)));

/** Full-width digits and signs, as Chinese keyboards have them, as ASCII has them; a minus of any kind as "-". */
const narrow = (text: string): string => text.normalize("NFKC").replace(/[\u2010-\u2015\u2212]/g, "-");

/** Reads a typed number, also with a comma; undefined for an empty field, null for an error. */
export function typed(text: string): number | undefined | null {
  const plain = narrow(text)
    .trim()
    .replace(/^([+-]?\d*),(\d+)$/, "$1.$2");
  if (!plain) return undefined;
  return /^[+-]?(\d+\.?\d*|\.\d+)$/.test(plain) ? Number(plain) : null;
}

/** Numbers with commas or blanks between them. */
export function typedList(text: string): number[] | undefined | null {
  const parts = narrow(text)
    .split(/[\s,;，；]+/)
    .filter(Boolean);
  if (!parts.length) return undefined;
  const numbers = parts.map(typed);
  return numbers.every((each) => typeof each === "number") ? (numbers as number[]) : null;
}
