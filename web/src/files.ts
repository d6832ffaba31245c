/** Files that come in: what they are, and what is wrong with them; and files that go out. */
import type { Word } from "./language.ts";
import { readEverything, type Everything } from "./store.ts";
import { readTape, TapeError, type ReadTape } from "./tape.ts";

/** What a file is; `refused`: a word of language.ts with its values, the file's name first. */
export type Found =
  | { kind: "program"; text: string }
  | { kind: "tape"; tape: ReadTape }
  | { kind: "saved"; saved: Everything }
  | { kind: "refused"; why: Word; values: (string | number)[] };

/** No program is longer: the board has 8 KiB. */
const MOST_PROGRAM = 64 * 1024;
const MOST = 16 * 1024 * 1024;

export const tooLarge = (name: string, size: number): Found | undefined =>
  size > MOST ? { kind: "refused", why: "badLarge", values: [name, MOST / 1024] } : undefined;

export function recognize(name: string, bytes: Uint8Array): Found {
  const refuse = (why: Word, ...values: (string | number)[]): Found => ({ kind: "refused", why, values: [name, ...values] });
  const large = tooLarge(name, bytes.length);
  if (large) return large;
  if (/\.(dxf|dwg)$/i.test(name)) return refuse("noDxf");
  if (/\.(xy|tkh)$/i.test(name)) return refuse("noXy");
  if (!bytes.length) return refuse("badEmpty");
  const text = new TextDecoder("latin1").decode(bytes);
  if (/^\s*\{/.test(text)) {
    const saved = readEverything(text);
    return saved ? { kind: "saved", saved } : refuse("badSaved");
  }
  // (an editor's mark at the start, a ctrl-Z at the end and blank tape are let pass)
  const plain = text.replace(/^\xef\xbb\xbf/, "").replace(/\x1a[^]*$/, "");
  const isTape = /\.3b$/i.test(name) || (!/\.skg$/i.test(name) && /(^|[\s:])B[ \t]*\d*[ \t]*B[ \t]*\d*[ \t]*B[ \t]*\d*[ \t]*G/i.test(plain));
  if (isTape) {
    try {
      return { kind: "tape", tape: readTape(plain) };
    } catch (error) {
      if (!(error instanceof TapeError)) throw error;
      return refuse("badTape", error.block, error.line, error.column, error.found);
    }
  }
  const strange = /[^\t\n\r -~\0]/.exec(plain);
  if (!/\.skg$/i.test(name) && (strange || !/^[\s\0]*\d+\s*[A-Za-z]/.test(plain))) return refuse("badKind");
  if (strange) return refuse("badText", text.indexOf(strange[0]) + 1);
  if (!plain.trim()) return refuse("badEmpty");
  if (plain.length > MOST_PROGRAM) return refuse("badLarge", MOST_PROGRAM / 1024);
  return { kind: "program", text: plain };
}

/** Gives the visitor a file. */
export function saveFile(name: string, text: string): void {
  const link = document.createElement("a");
  const url = URL.createObjectURL(new Blob([text], { type: "application/octet-stream" }));
  link.href = url;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}
