/** The pieces of the page that are no part of its script: fetched beside it, or in the page itself where that is one file. */
import { type Part, readParts } from "./parts.ts";
import type { Images } from "./runner.ts";

/** In skg.html: a piece in base64 by its name. */
const insideCode = (name: string): string | undefined =>
  document.querySelector(`script[data-file="${name}"]`)?.textContent?.trim();

function inside(name: string): ArrayBuffer | undefined {
  const text = insideCode(name);
  return text ? Uint8Array.from(atob(text), (character) => character.charCodeAt(0)).buffer : undefined;
}

/** The page is one file, skg.html. */
export const isOneFile = (): boolean => insideCode("worker.js") !== undefined;

/** The text of a file that lies in the page. */
export function insideText(name: string): string | undefined {
  const bytes = inside(name);
  return bytes && new TextDecoder().decode(bytes);
}

/** A picture in a page, by its file. */
export const PICTURE = /src="([\w-]+\.svg)"/g;

/** A page that lies in the page, with its pictures, which lie there, too. */
export function insidePage(name: string): string | undefined {
  return insideText(name)?.replace(PICTURE, (_, file: string) => `src="data:image/svg+xml;base64,${insideCode(file)}"`);
}

export function workerAddress(): string | URL {
  const bytes = inside("worker.js");
  return bytes ? URL.createObjectURL(new Blob([bytes], { type: "text/javascript" })) : new URL("worker.js", document.baseURI);
}

/** The machine's files, if they are inside the page: the worker cannot fetch them there. */
export function readImages(): Images | undefined {
  const [code, rom, sym] = ["board.wasm", "skg.bin", "skg.sym"].map(inside);
  return code && rom && sym ? { code, rom, sym } : undefined;
}

/** roms/skg.sym. */
export async function readSymbols(): Promise<string> {
  const text = insideText("skg.sym");
  if (text !== undefined) return text;
  const answer = await fetch("skg.sym");
  if (!answer.ok) throw new Error(`skg.sym: ${answer.status}`);
  return answer.text();
}

export async function readPartList(): Promise<Part[]> {
  const text = insideText("parts.json");
  return text === undefined ? readParts() : (JSON.parse(text) as Part[]);
}

/** One of the .wasm beside the page. */
export async function readModule(name: "walk.wasm" | "inside.wasm"): Promise<WebAssembly.Module> {
  const code = inside(name) ?? (await (await fetch(name)).arrayBuffer());
  return WebAssembly.compile(code);
}
