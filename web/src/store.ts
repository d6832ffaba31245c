/** The data kept from visit to visit, in the browser's own store. If that refuses, the user is told once, and the refused data
 * are kept until the page is left. */
import type { PunchedLine } from "./board.ts";
import type { Origin } from "./identity.ts";
import { type How, isHow, type KeptTape, type Maker } from "./recording.ts";
import type { Work } from "./works.ts";

export interface Kept {
  /** The RAM at the last prompt in base64, the program in it as LIST prints it, and the ROM's name. */
  ram: string;
  program: string;
  rom: string;
  paper: string;
  /** A text in the editor that is not in the machine. */
  draft?: string;
  about?: About;
}

/** The work that is written, the file that it came from, the address' link while the program is seen as it came from there. */
export interface About {
  work?: string | undefined;
  origin?: Origin | undefined;
  link?: string | undefined;
}

export type Theme = "auto" | "light" | "dark";

export interface Settings {
  speed: "real" | "fast";
  language: string;
  theme: Theme;
  wire: number;
  /** A change in the editor runs after a moment. */
  auto: boolean;
  grid: boolean;
  /** Steel under the wire while it goes. */
  plate: boolean;
  sound: boolean;
}

/** Everything as one file. */
export interface Everything {
  format: "skg-page";
  version: 1;
  kept: Kept | null;
  settings: Partial<Settings>;
  tape: string;
  /** The origin of a tape that is none of a file's, and its lines with their places. */
  made?: Maker;
  lines?: PunchedLine[];
  /** The tape was made in another way than by one RUN; the line of RUN n. */
  how?: How;
  from?: number;
  works?: Work[];
}

/** Names of the browser's store. Each copy of the page has its own, by the folder that it lies in: two on one server share nothing. */
const FOLDER = new URL(".", globalThis.location?.href ?? "http://localhost/").pathname;
const PREFIX = `skg:${FOLDER}:`;
const [MACHINE, SETTINGS, WORKS, OWNER, TAPE] = ["machine", "settings", "works", "owner", "tape"] as const;
/** Before copies had names of their own; read, never written. */
const COMMON = "skg.";

export class Store {
  #refused: (() => void) | undefined;
  readonly #unkept = new Map<string, string>();
  readonly #me = String(Math.random());
  #isMine = true;

  constructor(onRefused: () => void) {
    this.#refused = onRefused;
  }

  /** The browser has refused something that is gone when the page is left. */
  get isRefused(): boolean {
    return this.#unkept.size > 0;
  }

  /** Programs are among that. */
  get losesWorks(): boolean {
    return this.#unkept.has(WORKS);
  }

  /** This tab has the machine that is kept. */
  get isMine(): boolean {
    return this.#isMine;
  }

  get settings(): Partial<Settings> {
    return this.#read<Partial<Settings>>(SETTINGS) ?? {};
  }

  set settings(settings: Partial<Settings>) {
    this.#write(SETTINGS, { ...this.settings, ...settings });
  }

  get machine(): Kept | null {
    const kept = this.#read<Kept>(MACHINE);
    return isKept(kept) ? kept : null;
  }

  /** Written by the tab that has the machine alone. */
  set machine(kept: Kept | null) {
    if (this.#isMine) this.#write(MACHINE, kept);
  }

  /** The tape that was drawn last. */
  get tape(): KeptTape | null {
    const tape = this.#read<KeptTape>(TAPE);
    return isMaker(tape?.made) && areLines(tape?.lines) && isHow(tape?.how ?? "run") ? tape : null;
  }

  set tape(tape: KeptTape | null) {
    if (this.#isMine) this.#write(TAPE, tape);
  }

  get works(): Work[] {
    const works = this.#read<Work[]>(WORKS);
    return Array.isArray(works) ? works.filter(isWork) : [];
  }

  set works(works: Work[]) {
    this.#write(WORKS, works);
  }

  /** Takes the machine that is kept for this tab; `lost` is called when another one takes it. */
  own(lost: () => void): void {
    this.#isMine = true;
    this.#write(OWNER, this.#me);
    window.addEventListener("storage", (event) => {
      if (event.key !== PREFIX + OWNER || !this.#isMine || event.newValue === JSON.stringify(this.#me)) return;
      this.#isMine = false;
      lost();
    });
  }

  /** Takes it back from another tab. */
  ownAgain(): void {
    this.#isMine = true;
    this.#write(OWNER, this.#me);
  }

  /** Calls `changed` when another tab has written programs. */
  watch(changed: () => void): void {
    window.addEventListener("storage", (event) => {
      if (event.key === PREFIX + WORKS) changed();
    });
  }

  #read<T>(key: string): T | null {
    try {
      const there = this.#unkept.get(key) ?? localStorage.getItem(PREFIX + key) ?? localStorage.getItem(COMMON + key);
      return JSON.parse(there ?? "null") as T | null;
    } catch {
      return null;
    }
  }

  #write(key: string, value: unknown): void {
    const text = JSON.stringify(value);
    try {
      localStorage.setItem(PREFIX + key, text);
      this.#unkept.delete(key);
    } catch {
      this.#unkept.set(key, text);
      this.#refused?.();
      this.#refused = undefined;
    }
  }
}

function isPunched(line: unknown): line is PunchedLine {
  const { text, line: number, x, y } = (line ?? {}) as PunchedLine;
  return typeof text === "string" && [number, x, y].every((each) => typeof each === "number");
}

const areLines = (lines: unknown): lines is PunchedLine[] => Array.isArray(lines) && lines.every(isPunched);

function isMaker(made: unknown): made is Maker {
  const { name, program } = (made ?? {}) as Maker;
  return typeof name === "string" && (program === undefined || typeof program === "string");
}

function isWork(work: unknown): work is Work {
  const { id, name, when, program } = (work ?? {}) as Work;
  return [id, name, program].every((each) => typeof each === "string") && typeof when === "number";
}

const isKept = (kept: unknown): kept is Kept =>
  typeof kept === "object" &&
  kept !== null &&
  (["ram", "program", "rom", "paper"] as const).every((key) => typeof (kept as Kept)[key] === "string");

/** The page that was exported; undefined where the text is none. */
export function readEverything(text: string): Everything | undefined {
  try {
    const found = JSON.parse(text) as Everything;
    const isOne =
      found.format === "skg-page" &&
      found.version === 1 &&
      (found.kept === null || isKept(found.kept)) &&
      typeof found.settings === "object" &&
      isHow(found.how ?? "run") &&
      (found.made === undefined || isMaker(found.made)) &&
      (found.lines === undefined || areLines(found.lines)) &&
      (found.works ?? []).every(isWork) &&
      typeof found.tape === "string";
    return isOne ? found : undefined;
  } catch {
    return undefined;
  }
}

export const toBase64 = (bytes: Uint8Array): string => btoa(String.fromCharCode(...bytes));

export function fromBase64(text: string): Uint8Array | undefined {
  try {
    return Uint8Array.from(atob(text), (character) => character.charCodeAt(0));
  } catch {
    return undefined;
  }
}
