/** Signs that are not ASCII, on their way into the board.
 *
 * Word processors, web pages and Chinese keyboards write a minus, a quote or a bracket that the board has in another form: it
 * becomes the ASCII sign. Anything else is refused. emu/signs.c and tools/skg/signs.py have the same table; tests compare
 * them. */

/** ASCII sign -> its other forms, beside the full-width ones. */
const ROWS: Readonly<Record<string, string>> = {
  " ": "\u00a0\u2000\u2001\u2002\u2003\u2004\u2005\u2006\u2007\u2008\u2009\u200a\u202f\u205f\u3000",
  "-": "\u2010\u2011\u2012\u2013\u2014\u2015\u2212",
  "*": "\u00d7\u2217",
  "/": "\u00f7\u2044\u2215",
  ":": "\u2236",
  ".": "\u3002",
  '"': "\u201c\u201d\u201e\u201f\u2033",
  "'": "\u2018\u2019\u201a\u201b\u2032",
};
const TABLE = new Map(Object.entries(ROWS).flatMap(([sign, others]) => [...others].map((other) => [other, sign])));
/** The full-width forms of ! to ~ stand so far behind them. */
const WIDE = 0xfee0;

/** Every other form of an ASCII sign. */
export const OTHERS = new RegExp(`[\uff01-\uff5e${[...TABLE.keys()].join("")}]`, "g");

/** A text with the ASCII sign for each of its other forms; what else is not ASCII stays. */
export const withSigns = (text: string): string =>
  text.replace(OTHERS, (other) => TABLE.get(other) ?? String.fromCharCode(other.charCodeAt(0) - WIDE));

/** A character that the board has no sign for, and its column from 1. */
export interface Strange {
  character: string;
  column: number;
}

/** Keys that end a line, drop it, drop its last sign, or hold the paper and let it go on. */
const [ENDS, DROPS, RUBS, HOLDS] = ["\r\n", "\x03\x15", "\b\x7f", "\x11\x13"];
const CTRL_U = "\x15";

/** Keys on their way to the board, whenever they come: the same signs, and a line with a strange character is dropped. What
 * the board has of it is taken back by ctrl-U; the rest, up to RETURN, ctrl-U or ctrl-C, is not sent. */
export class Keys {
  #column = 0;
  #isDropped = false;

  /** The text that goes to the board, and the first strange character of each line that is dropped. */
  feed(text: string): { sent: string; strange: Strange[] } {
    let sent = "";
    const strange: Strange[] = [];
    for (const sign of withSigns(text)) {
      if (sign > "\x7f") {
        if (!this.#isDropped) {
          strange.push({ character: sign, column: this.#column + 1 });
          if (this.#column) sent += CTRL_U;
        }
        this.#isDropped = true;
      } else if (this.#isDropped && !HOLDS.includes(sign)) {
        if (!ENDS.includes(sign) && !DROPS.includes(sign)) continue;
        this.drop();
        if (DROPS.includes(sign)) sent += sign;
      } else {
        sent += sign;
        this.#count(sign);
      }
    }
    return { sent, strange };
  }

  /** The present line is given up: ctrl-C, reset, another program. */
  drop(): void {
    this.#isDropped = false;
    this.#column = 0;
  }

  #count(sign: string): void {
    if (ENDS.includes(sign) || DROPS.includes(sign)) this.#column = 0;
    else if (RUBS.includes(sign)) this.#column = Math.max(0, this.#column - 1);
    else if (sign >= " ") this.#column++;
  }
}
