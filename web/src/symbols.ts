/** The firmware's names (roms/skg.sym), as emu/symbols.c reads them: labels of the ROM with their source file, and equates. */

interface Symbol_ {
  value: number;
  name: string;
  /** Of a label: the file of asm/ where it stands. */
  file: string | undefined;
}

const ROM_SIZE = 0x2000;
/** A label says nothing of what is farther away. */
const NEAR = 0x400;
/** Characters of names of one address. */
const NAMES = 32;

export const hex = (value: number, digits = 4): string => value.toString(16).toUpperCase().padStart(digits, "0");

export class Symbols {
  readonly all: Symbol_[];
  readonly #labels: (Symbol_ | undefined)[] = [];

  constructor(sym: string) {
    this.all = sym
      .split("\n")
      .filter(Boolean)
      .map((line) => {
        const [value = "", name = "", file] = line.trim().split(/\s+/);
        return { value: parseInt(value, 16), name, file };
      });
    for (const label of this.all) {
      const there = this.#labels[label.value];
      if (isLabel(label) && (!there || isGap(there))) this.#labels[label.value] = label;
    }
    for (let at = 1; at < ROM_SIZE; at++) this.#labels[at] ??= this.#labels[at - 1];
  }

  value(name: string): number | undefined {
    return this.#find(name)?.value;
  }

  /** An address as a label and a distance: `CALC1+2`; four digits where there is no label near it. */
  place(address: number): string {
    const label = this.#labelAt(address);
    if (!label) return hex(address);
    return address === label.value ? label.name : `${label.name}+${address - label.value}`;
  }

  /** The source file of what stands there. */
  file(address: number): string | undefined {
    return this.#labelAt(address)?.file;
  }

  /** The names of what begins just there, a label or cells of RAM: `MWORK/TXTP`. */
  exact(address: number): string {
    let names = "";
    for (const each of this.all) {
      if (!isPlace(each) || each.value !== address || isGap(each) || names.length + each.name.length + 2 > NAMES) continue;
      names += (names && "/") + each.name;
    }
    return names;
  }

  /** An address as one writes it: a label or a cell, one with a distance (`CALC1+2`), or hexadecimal digits. */
  address(text: string): number | undefined {
    const [, name = "", distance] = /^([^+]*)(?:\+(\d{1,5}))?$/.exec(text.trim()) ?? [];
    const found = this.#find(name);
    if (found && isPlace(found)) return (found.value + Number(distance ?? 0)) & 0xffff;
    return /^[0-9a-f]{1,4}$/i.test(text.trim()) ? parseInt(text, 16) : undefined;
  }

  #labelAt(address: number): Symbol_ | undefined {
    const label = this.#labels[address];
    return label && address - label.value <= NEAR ? label : undefined;
  }

  #find(name: string): Symbol_ | undefined {
    return this.all.find((each) => each.name === name.toUpperCase());
  }
}

/** DS lines in front of the restarts have labels of their own, which name nothing but a gap. */
const isGap = ({ name }: Symbol_): boolean => name.startsWith("GAP");

const isLabel = ({ value, file }: Symbol_): boolean => file !== undefined && value < ROM_SIZE;

const isPlace = (symbol: Symbol_): boolean => isLabel(symbol) || symbol.value >= ROM_SIZE;
