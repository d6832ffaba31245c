/** Machine code with what stands behind its restarts, as `list` of `skg80 --debug` prints it. */
import type { Calculator, Line } from "./calculator.ts";
import { disassemble } from "./disasm.ts";
import { hex, type Symbols } from "./symbols.ts";

/** Restarts with a byte behind them (an error's number, a character that is expected), and with byte-code. */
const RST_ERROR = 0xcf;
const RST_EXPECT = 0xe7;
const RST_CALC = 0xef;
const LONGEST = 1000;

/** So many instructions from an address on. */
export function instructions(symbols: Symbols, calculator: Calculator, memory: Uint8Array, from: number, count: number): Line[] {
  const lines: Line[] = [];
  let at = from;
  for (let left = count; left; left--) {
    const opcode = memory[at] ?? 0;
    const { text, length } = disassemble(symbols, memory, at);
    lines.push({ address: at, text });
    at = (at + length) & 0xffff;
    if (opcode === RST_ERROR || opcode === RST_EXPECT) {
      lines.push({ address: at, text: `DB ${hex(memory[at] ?? 0, 2)}` });
      at = (at + 1) & 0xffff;
    } else if (opcode === RST_CALC) {
      const code = calculator.listing(memory, at, LONGEST);
      lines.push(...code.lines);
      at = code.behind;
    }
  }
  return lines;
}
