/** SKG for the editor: its words coloured, and the number of the line that follows. */
import { HighlightStyle, StreamLanguage, syntaxHighlighting } from "@codemirror/language";
import { tags } from "@lezer/highlight";

const WORDS = /^(?:FROM|CUT|BACK|END|REM|PRINT|GOTO|IF|GOSUB|RETURN|READ|DATA|RESTORE|INPUT|SCALE|SYM|REP|RECUT|FIT|TOL)/i;
const FUNCTIONS = /^(?:SQR|SIN|COS|TG|ATG|ABS|INT|K[123])/i;

const words = StreamLanguage.define<{ remark: boolean }>({
  startState: () => ({ remark: false }),
  token(stream, state) {
    if (stream.sol()) {
      state.remark = false;
      if (stream.match(/^\s*\d+\s*/)) return "meta";
    }
    if (state.remark) {
      stream.skipToEnd();
      return "comment";
    }
    if (stream.match(/^REM/i)) {
      state.remark = true;
      return "comment";
    }
    if (stream.match(/^"[^"]*"?/)) return "string";
    if (stream.match(FUNCTIONS)) return "typeName";
    if (stream.match(WORDS)) return "keyword";
    if (stream.match(/^\d*\.?\d+(?:E[-+]?\d+)?/i)) return "number";
    if (stream.match(/^[A-Z]\d*/i)) return "variableName";
    stream.next();
    return null;
  },
});

const colours = HighlightStyle.define([
  { tag: tags.meta, color: "var(--dim)" },
  { tag: tags.comment, color: "var(--remark)", fontStyle: "italic" },
  { tag: tags.keyword, color: "var(--strong)", fontWeight: "600" },
  { tag: tags.typeName, color: "var(--strong)" },
  { tag: tags.number, color: "var(--number)" },
  { tag: tags.string, color: "var(--remark)" },
]);

export const skg = [words, syntaxHighlighting(colours)];

/** The line number behind `before`, ten more, or between it and `after`; undefined where there is no room. */
export function nextNumber(before: string, after: string): number | undefined {
  const [last, next] = [before, after].map((line) => /^\s*(\d+)/.exec(line)?.[1]);
  if (last === undefined) return undefined;
  const wanted = Math.floor(Number(last) / 10) * 10 + 10;
  if (next === undefined || wanted < Number(next)) return wanted;
  const middle = Math.floor((Number(last) + Number(next)) / 2);
  return middle > Number(last) ? middle : undefined;
}

/** An error that the page finds in a text before the machine reads it. */
export interface Fault {
  row: number;
  column: number;
  word: "noNumber" | "twice" | "notAscii";
  value: string;
}

export function faultsOf(text: string): Fault[] {
  const seen = new Set<number>();
  return text.split("\n").flatMap((line, row): Fault[] => {
    if (!line.trim()) return [];
    const strange = /[^\t\r -~]/u.exec(line);
    if (strange) return [{ row, column: strange.index, word: "notAscii", value: strange[0] }];
    const number = /^\s*(\d+)/.exec(line)?.[1];
    if (number === undefined) return [{ row, column: 0, word: "noNumber", value: "" }];
    const isTwice = seen.has(Number(number));
    seen.add(Number(number));
    return isTwice ? [{ row, column: 0, word: "twice", value: number }] : [];
  });
}
