/** Foreign names (files, layers, labels) as the page shows them: the rule of `skg.wording.visible`. */

/** What a browser obeys instead of showing it: controls, marks of direction, other blanks than those that names have. */
const OBEYED = /[\p{C}\p{Zl}\p{Zp}]|(?![ \u00a0\u3000])\p{Zs}/gu;
/** Letters that are written from right to left: they would take what stands beside them along. */
const FROM_RIGHT = /[\u0590-\u08ff\ufb1d-\ufdff\ufe70-\ufeff\u{10800}-\u{10fff}\u{1e800}-\u{1efff}]/u;

/** A name in which what is obeyed is an escape, such as \x1b or \u202e. */
export function visible(text: string): string {
  const shown = text.replace(OBEYED, escaped);
  return FROM_RIGHT.test(shown) ? `\u2068${shown}\u2069` : shown;
}

function escaped(character: string): string {
  const code = character.codePointAt(0) ?? 0;
  if (code <= 0xff) return `\\x${code.toString(16).padStart(2, "0")}`;
  return code <= 0xffff ? `\\u${code.toString(16).padStart(4, "0")}` : `\\U${code.toString(16).padStart(8, "0")}`;
}
