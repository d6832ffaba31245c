/** 8080 machine code as Intel's mnemonics with the firmware's names, as emu/disasm.c writes them. */
import { hex, type Symbols } from "./symbols.ts";

const REGISTER = ["B", "C", "D", "E", "H", "L", "M", "A"];
const PAIR = ["B", "D", "H", "SP"];
const CONDITION = ["NZ", "Z", "NC", "C", "PO", "PE", "P", "M"];
const ARITHMETIC = ["ADD", "ADC", "SUB", "SBB", "ANA", "XRA", "ORA", "CMP"];
const IMMEDIATE = ["ADI", "ACI", "SUI", "SBI", "ANI", "XRI", "ORI", "CPI"];
const ROTATE = ["RLC", "RRC", "RAL", "RAR", "DAA", "CMA", "STC", "CMC"];
const MEMORY = ["STAX B", "LDAX B", "STAX D", "LDAX D", "SHLD", "LHLD", "STA", "LDA"];
const JUMPS: readonly Named[] = [
  ["JMP", 3],
  ["JMP", 3],
  ["OUT", 2],
  ["IN", 2],
  ["XTHL", 1],
  ["XCHG", 1],
  ["DI", 1],
  ["EI", 1],
];
const ODD = ["RET", "RET", "PCHL", "SPHL"];
const HLT = 0x76;
const RST = 0xc7;

/** A mnemonic with its registers, and the bytes of the instruction. */
type Named = readonly [name: string, length: 1 | 2 | 3];

function lowQuarter(y: number, z: number): Named {
  const pair = PAIR[y >> 1];
  switch (z) {
    case 0:
      return ["NOP", 1];
    case 1:
      return y & 1 ? [`DAD ${pair}`, 1] : [`LXI ${pair}`, 3];
    case 2:
      return [MEMORY[y] ?? "", y < 4 ? 1 : 3];
    case 3:
      return [`${y & 1 ? "DCX" : "INX"} ${pair}`, 1];
    case 6:
      return [`MVI ${REGISTER[y]}`, 2];
    case 7:
      return [ROTATE[y] ?? "", 1];
    default:
      return [`${z === 4 ? "INR" : "DCR"} ${REGISTER[y]}`, 1];
  }
}

function highQuarter(y: number, z: number): Named {
  const pair = y >> 1 === 3 ? "PSW" : PAIR[y >> 1];
  switch (z) {
    case 0:
      return [`R${CONDITION[y]}`, 1];
    case 1:
      return [y & 1 ? (ODD[y >> 1] ?? "") : `POP ${pair}`, 1];
    case 2:
      return [`J${CONDITION[y]}`, 3];
    case 3:
      return JUMPS[y] ?? ["", 1];
    case 4:
      return [`C${CONDITION[y]}`, 3];
    case 5:
      return y & 1 ? ["CALL", 3] : [`PUSH ${pair}`, 1];
    case 6:
      return [IMMEDIATE[y] ?? "", 2];
    default:
      return [`RST ${y}`, 1];
  }
}

function nameOf(opcode: number): Named {
  const [y, z] = [(opcode >> 3) & 7, opcode & 7];
  switch (opcode >> 6) {
    case 0:
      return lowQuarter(y, z);
    case 1:
      return [opcode === HLT ? "HLT" : `MOV ${REGISTER[y]},${REGISTER[z]}`, 1];
    case 2:
      return [`${ARITHMETIC[y]} ${REGISTER[z]}`, 1];
    default:
      return highQuarter(y, z);
  }
}

/** The instruction at an address, and its length. */
export function disassemble(symbols: Symbols, memory: Uint8Array, address: number): { text: string; length: number } {
  const byte = (at: number): number => memory[(address + at) & 0xffff] ?? 0;
  const [name, length] = nameOf(byte(0));
  const comma = name.includes(" ") ? "," : " ";
  const restart = (byte(0) & RST) === RST ? symbols.exact(byte(0) & 0x38) : "";
  if (restart) return { text: `${name} ${restart}`, length };
  if (length === 1) return { text: name, length };
  if (length === 2) return { text: `${name}${comma}${hex(byte(1), 2)}`, length };
  const word = byte(1) | (byte(2) << 8);
  return { text: `${name}${comma}${symbols.exact(word) || hex(word)}`, length };
}
