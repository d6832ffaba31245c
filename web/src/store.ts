/** What the page keeps from visit to visit, in the browser's own store; where that refuses, it is told once. */

export interface Kept {
  /** The RAM at the last prompt in base64, the program in it as LIST prints it, and the ROM's name. */
  ram: string;
  program: string;
  rom: string;
  paper: string;
}

export type Theme = "auto" | "light" | "dark";

export interface Settings {
  speed: "real" | "fast";
  language: string;
  theme: Theme;
  wire: number;
}

/** Everything as one file. */
export interface Everything {
  format: "skg-page";
  version: 1;
  kept: Kept | null;
  settings: Partial<Settings>;
  tape: string;
}

const MACHINE = "skg.machine";
const SETTINGS = "skg.settings";

export class Store {
  #refused: (() => void) | undefined;

  constructor(onRefused: () => void) {
    this.#refused = onRefused;
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

  set machine(kept: Kept | null) {
    this.#write(MACHINE, kept);
  }

  #read<T>(key: string): T | null {
    try {
      return JSON.parse(localStorage.getItem(key) ?? "null") as T | null;
    } catch {
      return null;
    }
  }

  #write(key: string, value: unknown): void {
    try {
      localStorage.setItem(key, JSON.stringify(value));
    } catch {
      this.#refused?.();
      this.#refused = undefined;
    }
  }
}

const isKept = (kept: unknown): kept is Kept =>
  typeof kept === "object" && kept !== null &&
  (["ram", "program", "rom", "paper"] as const).every((key) => typeof (kept as Kept)[key] === "string");

/** The page that was exported; undefined where the text is none. */
export function readEverything(text: string): Everything | undefined {
  try {
    const found = JSON.parse(text) as Everything;
    const isOne = found.format === "skg-page" && found.version === 1 && (found.kept === null || isKept(found.kept)) &&
      typeof found.settings === "object" && typeof found.tape === "string";
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
