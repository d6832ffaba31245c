/** The firmware as a reader of its inside sees it: names, listings, the calculator's values (wasm/inside.c). */

/** A line of a listing: its address, the label that it is at or behind (none: data), the instruction or operation. */
export interface Line {
  address: number;
  place: string;
  text: string;
}

/** A register of the calculator that is not 0: M and its number, its names, its value. */
export interface Register {
  number: string;
  names: string;
  value: string;
}

interface Exports {
  memory: WebAssembly.Memory;
  _initialize(): void;
  inside_buffer(length: number): number;
  inside_names(): number;
  inside_memory(): void;
  inside_value(): number;
  inside_address(): number;
  inside_place(address: number): number;
  inside_file(address: number): number;
  inside_listing(address: number, count: number): number;
  inside_code(address: number, count: number): number;
  inside_floats(): number;
  inside_registers(): number;
}

/** The C library's files: there are none. */
const BAD_FILE = 8;
const noFile = (): number => BAD_FILE;
const NO_FILES = { wasi_snapshot_preview1: { fd_close: noFile, fd_seek: noFile, fd_write: noFile } };

export const hex = (value: number, digits = 4): string => value.toString(16).toUpperCase().padStart(digits, "0");

export class Firmware {
  readonly #wasm: Exports;

  private constructor(wasm: Exports) {
    this.#wasm = wasm;
  }

  /** `module` is inside.wasm, `sym` roms/skg.sym; an Error where that is none. */
  static async create(module: WebAssembly.Module, sym: string): Promise<Firmware> {
    const wasm = (await WebAssembly.instantiate(module, NO_FILES)).exports as unknown as Exports;
    wasm._initialize();
    const firmware = new Firmware(wasm);
    firmware.#give(sym);
    const fault = firmware.#text(wasm.inside_names());
    if (fault) throw new Error(fault);
    return firmware;
  }

  /** Looks at this memory, all 64 KiB of it, from now on. */
  look(memory: Uint8Array): void {
    this.#put(memory);
    this.#wasm.inside_memory();
  }

  value(name: string): number | undefined {
    this.#give(name);
    return found(this.#wasm.inside_value());
  }

  /** An address as one writes it: a label or a cell, one with a distance (`CALC1+2`), or hexadecimal digits. */
  address(text: string): number | undefined {
    this.#give(text.trim());
    return found(this.#wasm.inside_address());
  }

  /** An address as a label and a distance: `CALC1+2`; four digits where there is no label near it. */
  place(address: number): string {
    return this.#text(this.#wasm.inside_place(address));
  }

  /** The source file of what stands there; empty where nothing has a name. */
  file(address: number): string {
    return this.#text(this.#wasm.inside_file(address));
  }

  /** So many instructions from an address on, with the data behind restarts. */
  listing(address: number, count: number): Line[] {
    return lines(this.#text(this.#wasm.inside_listing(address, count)));
  }

  /** Byte-code from an address on, so many operations or up to its end. */
  code(address: number, count: number): Line[] {
    return lines(this.#text(this.#wasm.inside_code(address, count)));
  }

  /** The float stack, the top last. */
  floats(): string[] {
    return this.#text(this.#wasm.inside_floats()).split(" ").filter(Boolean);
  }

  registers(): Register[] {
    const rows = this.#text(this.#wasm.inside_registers()).matchAll(/^(\S+) +(\S+) +(\S+)$/gm);
    return [...rows].map(([, number = "", names = "", value = ""]) => ({ number, names, value }));
  }

  #put(bytes: Uint8Array): void {
    const at = this.#wasm.inside_buffer(bytes.length);
    new Uint8Array(this.#wasm.memory.buffer).set(bytes, at);
  }

  #give(text: string): void {
    this.#put(new TextEncoder().encode(`${text}\0`));
  }

  #text(at: number): string {
    const bytes = new Uint8Array(this.#wasm.memory.buffer, at);
    return new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)));
  }
}

const found = (value: number): number | undefined => (value < 0 ? undefined : value);

/** The lines of a listing. */
function lines(text: string): Line[] {
  const rows = text.matchAll(/^(\w{4}) (\S*) +(.*)$/gm);
  return [...rows].map(([, address = "", place = "", line = ""]) => ({ address: parseInt(address, 16), place, text: line }));
}
