/** The firmware's calculator as a reader of it sees it, as emu/calculator.c does: byte-code by its names, floats as decimal
 * numbers. */
import { hex, type Symbols } from "./symbols.ts";

/** The first code of each kind. */
const OPERATIONS = 0x40;
const LOADS = 0x40;
const STORES = 0x80;
const CONSTANTS = 0xc0;
const FLOAT = 5;
const DEPTH = 12;
const EXCESS = 128;
/** Characters of names of one code. */
const NAMES = 32;

/** A line of a listing. */
export interface Line {
  address: number;
  text: string;
}

export class Calculator {
  readonly #symbols: Symbols;
  readonly #names: string[] = new Array(256).fill("");
  readonly #isJump = new Set<number>();
  readonly #end: number;
  readonly #leave: number;
  /** The address at which the calculator takes its next operation, the byte at BC. */
  readonly next: number;

  constructor(symbols: Symbols) {
    this.#symbols = symbols;
    [this.#end, this.#leave, this.next] = ["QEND", "QRET", "CALC1"].map((name) => this.#value(name)) as [number, number, number];
    for (const { name, value, file } of symbols.all) {
      const isEquate = file === undefined;
      if (isEquate && name.startsWith("L") && value >= LOADS && value < STORES) {
        const store = `S${name.slice(1)}`;
        if (symbols.value(store) !== value + STORES - LOADS) continue;
        this.#add(value, name);
        this.#add(value + STORES - LOADS, store);
      } else if (isEquate && name.startsWith("Q") && (value < OPERATIONS || (value >= CONSTANTS && value < 256))) {
        this.#add(value, name);
        if (value < OPERATIONS && name[1] === "J") this.#isJump.add(value);
      }
    }
    for (let code = this.#leave + 1; code < 256; code++) {
      const name = this.#names[code - this.#leave];
      if (name && !this.#isJump.has(code - this.#leave)) this.#names[code] = `${name}+QRET`;
    }
  }

  /** The operation at an address: its name and, behind a register or a constant, its value now; behind a jump, its target. */
  operation(memory: Uint8Array, address: number): { text: string; length: number } {
    const code = memory[address] ?? 0;
    const name = this.#names[code] || `?${hex(code, 2)}`;
    if (this.#isJump.has(code)) return { text: `${name} ${this.#symbols.place(jump(memory, address))}`, length: 2 };
    const value = (table: string, first: number): string =>
      `${name} (${general(floatAt(memory, this.#value(table) + FLOAT * (code - first)))})`;
    if (code >= CONSTANTS && code < this.#leave) return { text: value("CONTAB", CONSTANTS), length: 1 };
    if (code >= LOADS && code < STORES) return { text: value("MREG", LOADS), length: 1 };
    return { text: name, length: 1 };
  }

  /** Byte-code from an address on, for so many operations or up to its end: QEND, or a QRET that no jump before leads past. */
  listing(memory: Uint8Array, address: number, count: number): { lines: Line[]; behind: number } {
    const targets = new Set<number>();
    const lines: Line[] = [];
    let at = address;
    for (let isEnd = false; !isEnd && lines.length < count; ) {
      const code = memory[at] ?? 0;
      if (this.#isJump.has(code)) targets.add(jump(memory, at) & 0xff);
      const { text, length } = this.operation(memory, at);
      lines.push({ address: at, text });
      targets.delete(at & 0xff);
      at = (at + length) & 0xffff;
      isEnd = code === this.#end || (code >= this.#leave && !targets.has(at & 0xff));
    }
    return { lines, behind: at };
  }

  /** The float stack, the top last; undefined where its pointer is elsewhere. */
  stack(memory: Uint8Array): number[] | undefined {
    const [cell, bottom] = [this.#value("FSP"), this.#value("FSTK")];
    const top = (memory[cell] ?? 0) | ((memory[cell + 1] ?? 0) << 8);
    const depth = ((top + FLOAT - bottom) & 0xff) / FLOAT;
    if (depth > DEPTH) return undefined;
    return Array.from({ length: Math.floor(depth) }, (_, at) => floatAt(memory, bottom + FLOAT * at));
  }

  /** The registers that have a name and are not 0: M and its number, their names, their values. */
  registers(memory: Uint8Array): { number: number; names: string; value: number }[] {
    return Array.from({ length: STORES - LOADS }, (_, number) => ({
      number,
      names: (this.#names[LOADS + number] ?? "").replace(/(^|\/)L/g, "$1"),
      value: floatAt(memory, this.#value("MREG") + FLOAT * number),
    })).filter(({ names, value }) => names && value);
  }

  #value(name: string): number {
    const value = this.#symbols.value(name);
    if (value === undefined) throw new Error(`skg.sym has no ${name}`);
    return value;
  }

  #add(code: number, name: string): void {
    const text = this.#names[code] ?? "";
    if (text.length + name.length + 2 < NAMES) this.#names[code] = text ? `${text}/${name}` : name;
  }
}

/** The target of the jump at an address: its distance counts from its second byte on. */
const jump = (memory: Uint8Array, address: number): number => (address + 1 + (((memory[address + 1] ?? 0) << 24) >> 24)) & 0xffff;

/** A float of the firmware's: excess, then the mantissa with the sign in place of its first bit. */
function floatAt(memory: Uint8Array, address: number): number {
  const [exponent = 0, high = 0, ...low] = memory.subarray(address, address + FLOAT);
  if (!exponent) return 0;
  const mantissa = low.reduce((sum, byte) => sum * 256 + byte, high | 0x80);
  return (high & 0x80 ? -1 : 1) * mantissa * 2 ** (exponent - EXCESS - 32);
}

/** A number with nine digits, as C's %.9g. */
export function general(value: number): string {
  const [mantissa = "", exponent = "0"] = value.toExponential(8).split("e");
  const power = Number(exponent);
  if (power >= -4 && power < 9) return String(Number(value.toPrecision(9)));
  return `${Number(mantissa)}e${power < 0 ? "-" : "+"}${String(Math.abs(power)).padStart(2, "0")}`;
}
