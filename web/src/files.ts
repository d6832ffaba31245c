/** Files that come in: their kinds and errors; and files that go out. */
import type { Word } from "./language.ts";
import { layOutSteps } from "./placed.ts";
import type { Opened } from "./recording.ts";
import { type Everything, readEverything } from "./store.ts";
import { readTapeSteps, TapeError } from "./tape.ts";
import { writeSteps } from "./written.ts";

/** The kind of a file; `refused`: a word of language.ts with its values, the file's name first. */
export type Found =
  | { kind: "program"; text: string }
  | { kind: "lessons"; text: string }
  | { kind: "tape"; text: string }
  | { kind: "saved"; saved: Everything }
  | { kind: "refused"; why: Word; values: (string | number)[] };

/** No program is longer: the board has 8 KiB. */
const MOST_PROGRAM = 64 * 1024;
/** A tape of some 150,000 blocks: so many are opened, drawn and walked through without a halt. */
const MOST = 2 * 1024 * 1024;
/** Everything as one file: such a tape, and all programs that a browser keeps. */
const MOST_SAVED = 8 * MOST;

export function tooLarge(name: string, size: number): Found | undefined {
  const most = /\.json$/i.test(name) ? MOST_SAVED : MOST;
  return size > most ? { kind: "refused", why: "badLarge", values: [name, most / 1024] } : undefined;
}

export function recognize(name: string, bytes: Uint8Array): Found {
  const refuse = (why: Word, ...values: (string | number)[]): Found => ({ kind: "refused", why, values: [name, ...values] });
  const large = tooLarge(name, bytes.length);
  if (large) return large;
  if (/\.(dxf|dwg|svg)$/i.test(name)) return refuse("noDxf");
  if (/\.(nc|iso|ngc|gcode|cnc|tap)$/i.test(name)) return refuse("noIso");
  if (/\.(xy|tkh)$/i.test(name)) return refuse("noXy");
  if (!bytes.length) return refuse("badEmpty");
  const text = new TextDecoder("latin1").decode(bytes);
  if (/\.md$/i.test(name)) return { kind: "lessons", text: utf8(bytes) ?? text };
  if (/^\s*\{/.test(text)) {
    const saved = readEverything(utf8(bytes) ?? text);
    return saved ? { kind: "saved", saved } : refuse("badSaved");
  }
  // (an editor's mark at the start, a ctrl-Z at the end and blank tape, such as that of SAVE, are let pass)
  const plain = text.replace(/^\xef\xbb\xbf/, "").replace(/\x1a[^]*$/, "");
  const isTape =
    /\.3b$/i.test(name) || (!/\.skg$/i.test(name) && /(^|[\s:])B[ \t]*\d*[ \t]*B[ \t]*\d*[ \t]*B[ \t]*\d*[ \t]*G/i.test(plain));
  if (isTape) return { kind: "tape", text: plain };
  const strange = /[^\t\n\r -~\0]/.exec(plain);
  if (!/\.skg$/i.test(name) && ((strange && !utf8(bytes)) || !/^[\s\0]*\d+\s*[A-Za-z]/.test(plain))) return refuse("badKind");
  const program = strange ? utf8(bytes) : plain.replace(/\0/g, "");
  if (program === undefined) return refuse("badText", text.indexOf(strange?.[0] ?? "") + 1);
  if (!program.trim()) return refuse("badEmpty");
  if (program.length > MOST_PROGRAM) return refuse("badLarge", MOST_PROGRAM / 1024);
  return { kind: "program", text: program };
}

/** A text in UTF-8, undefined where it is none: signs that the machine has not are marked in the editor. */
function utf8(bytes: Uint8Array): string | undefined {
  try {
    const text = new TextDecoder("utf-8", { fatal: true }).decode(bytes).replace(/\x1a[^]*$/, "");
    return /[\x00-\x08\x0e-\x1f\x7f]/.test(text) ? undefined : text;
  } catch {
    return undefined;
  }
}

/** Longest time that a file's reading holds the page up at a stretch, ms. */
const SLICE = 12;

/** Reads and lays out a tape, and lets the page go on meanwhile. */
export async function readWhole(
  name: string,
  text: string,
): Promise<({ isForeign: boolean } & Opened) | { why: Word; values: (string | number)[] }> {
  try {
    const { items, isForeign, hasNoEnd } = await inSlices(readTapeSteps(text));
    const placer = await inSlices(layOutSteps(items));
    const written = await inSlices(writeSteps(items, !hasNoEnd));
    return { items, isForeign, placer, written, isWhole: !hasNoEnd };
  } catch (error) {
    if (!(error instanceof TapeError)) throw error;
    return { why: "badTape", values: [name, error.block, error.line, error.column, error.found] };
  }
}

async function inSlices<T>(steps: Generator<undefined, T>): Promise<T> {
  for (;;) {
    const end = performance.now() + SLICE;
    while (performance.now() < end) {
      const step = steps.next();
      if (step.done) return step.value;
    }
    await new Promise((resume) => setTimeout(resume));
  }
}

/** Gives the visitor a file. */
export function saveFile(name: string, content: BlobPart): void {
  const link = document.createElement("a");
  const url = URL.createObjectURL(new Blob([content], { type: "application/octet-stream" }));
  link.href = url;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}
