/** The SKG board in WebAssembly (wasm/page.c): the real ROM, the emulator's own core and board. */

/** Why a run ended, in the order of `board_reason` (emu/board.h). */
const REASONS = ["cycles", "prompt", "input", "wait", "halt", "break", "nobody"] as const;
export type Reason = (typeof REASONS)[number];

/** Addresses out of roms/skg.sym, see page_names in wasm/page.c. */
export interface Names {
  current: number;
  direct: number;
  element: number;
  along: number;
  run: number;
  ready: number;
  save: number;
  wire: number;
  operation: number;
}

/** A line on the punch: a block, `D` or `DD`, or one of a program that SAVE punches; the program line that made it (0: a direct
 * statement), and where the wire stands behind it, whole µm. */
export interface PunchedLine {
  text: string;
  line: number;
  x: number;
  y: number;
}

/** The marks between punched lines, in the order of page.c's, behind the note of a line. */
const MARKS = ["run", "prompt", "save", "reset"] as const;

/** A mark: RUN begins (`from`: the line of RUN n, else 0), the board comes to its prompt, SAVE begins, the reset button. A line
 * that was not whole before it is no line. */
export interface PunchMark {
  mark: (typeof MARKS)[number];
  from: number;
}

export type Punched = PunchedLine | PunchMark;

interface Exports {
  memory: WebAssembly.Memory;
  page_buffer(length: number): number;
  page_names(
    current: number,
    direct: number,
    element: number,
    along: number,
    run: number,
    ready: number,
    save: number,
    wire: number,
    operation: number,
  ): void;
  page_board(which: number, length: number): number;
  page_reset(which: number): void;
  page_type(which: number, length: number): number;
  page_press(which: number, key: number): number;
  page_forget(which: number): void;
  page_tape(which: number, length: number): number;
  page_take_tape(which: number): void;
  page_idle(which: number): number;
  page_silence(which: number): number;
  page_baud(which: number, baud: number): void;
  page_cycles(which: number): number;
  page_run(which: number, cycles: number): number;
  page_stop_at(which: number, address: number, stops: number): number;
  page_step(which: number, how: number, stack: number, cycles: number): number;
  page_registers(which: number): number;
  page_memory(which: number): number;
  page_printed(which: number): number;
  page_take_paper(which: number): number;
  page_punched(which: number): number;
  page_take_punch(which: number): number;
  page_noted(which: number): number;
  page_take_notes(which: number): number;
  page_save(which: number): number;
  page_restore(which: number, length: number): void;
}

/** The steps of the debugger: an instruction, to the calculator's next operation, until the stack pointer is above a value; in
 * the order of page_step. */
const STEPS = ["instruction", "operation", "return"] as const;
export type Step = (typeof STEPS)[number];

/** The board's state for the debugger: A with F, BC, DE, HL, SP and PC; all memory. */
export interface Look {
  af: number;
  bc: number;
  de: number;
  hl: number;
  sp: number;
  pc: number;
  memory: Uint8Array;
  cycles: number;
}

const RAM_BYTES = 8192;
export const ROM_BYTES = 8192;
/** Numbers of a note beside the punch: its place, its kind, a line, x, y; each of 8 bytes. */
const NOTE = 5;
const VISITORS = 0;
const SCRATCH = 1;
const SPACE = 65536;
/** Cycles that LIST and a reset may take on the second board: 50 s of the real one. */
const PATIENCE = 100_000_000;
const [NEW_LINE, BLANK, RUBOUT] = [10, 32, 127];
/** LOAD looks at the empty reader for so many cycles before it is said that it waits for a tape. */
const SILENCE = 6_000_000;

/** Bytes of what RUN does before it begins: CALL, MOV, ORA, CNZ. */
const UNTIL_RUN = 8;

/** Addresses for `Names` from a .sym file: lines with a hexadecimal value and a name. A missing name is an Error. */
export function readNames(sym: string): Names {
  const values = new Map(
    sym.split("\n").map((line) => {
      const [value = "", name = ""] = line.split(/\s+/);
      return [name, parseInt(value, 16)] as const;
    }),
  );
  const value = (name: string): number => {
    const found = values.get(name);
    if (found === undefined) throw new Error(`skg.sym has no ${name}`);
    return found;
  };
  const register = value("SWX") - 0x80;
  return {
    current: value("CURLIN"),
    direct: value("NXTP"),
    element: value("NTOC"),
    along: value("ADVANC"),
    // Behind the calls that end its line (one that is only looked at, 10 RUN, does not come back from there) and look for n.
    run: value("SRUN") + UNTIL_RUN,
    ready: value("READY"),
    save: value("SSAVE"),
    wire: value("MREG") + 5 * register,
    operation: value("CALC1"),
  };
}

export class Board {
  readonly #wasm: Exports;
  readonly #rom: Uint8Array;
  /** The line on the punch that is not whole yet, and its note. */
  #rest: number[] = [];
  #restOf: Omit<PunchedLine, "text"> = { line: 0, x: 0, y: 0 };
  #scratch = false;

  private constructor(wasm: Exports, rom: Uint8Array, names: Names) {
    this.#wasm = wasm;
    this.#rom = rom;
    const { current, direct, element, along, run, ready, save, wire, operation } = names;
    wasm.page_names(current, direct, element, along, run, ready, save, wire, operation);
    this.#make(VISITORS);
  }

  /** A board with this ROM, before its first reset ends; `module` is board.wasm. */
  static async create(module: WebAssembly.Module, rom: Uint8Array, names: Names): Promise<Board> {
    const instance = await WebAssembly.instantiate(module, {});
    return new Board(instance.exports as unknown as Exports, rom, names);
  }

  type(bytes: Uint8Array): void {
    this.#wasm.page_type(VISITORS, this.#give(bytes));
  }

  press(key: number): void {
    this.#wasm.page_press(VISITORS, key);
  }

  forget(): void {
    this.#wasm.page_forget(VISITORS);
  }

  /** Puts a tape into the reader, in the old one's place. */
  tape(bytes: Uint8Array): void {
    this.#wasm.page_take_tape(VISITORS);
    this.#wasm.page_tape(VISITORS, this.#give(bytes));
  }

  /** The reset button. */
  reset(): void {
    this.#wasm.page_reset(VISITORS);
  }

  /** 0: no time at all. */
  baud(baud: number): void {
    this.#wasm.page_baud(VISITORS, baud);
  }

  run(cycles: number): Reason {
    return REASONS[this.#wasm.page_run(VISITORS, cycles)] ?? "halt";
  }

  /** Has `run` and `step` stop at an address, of machine code or byte-code, with the reason `break`; false when there are too
   * many of them. */
  stopAt(address: number, stops: boolean): boolean {
    return this.#wasm.page_stop_at(VISITORS, address, Number(stops)) !== 0;
  }

  /** Goes on so far, for so many cycles at most; `break`: it is there, or at a stop. */
  step(how: Step, stack: number, cycles: number): Reason {
    return REASONS[this.#wasm.page_step(VISITORS, STEPS.indexOf(how), stack, cycles)] ?? "halt";
  }

  look(): Look {
    const bytes = this.#copy(this.#wasm.page_registers(VISITORS), 12);
    const [af, bc, de, hl, sp, pc] = Array.from({ length: 6 }, (_, at) => new DataView(bytes.buffer).getUint16(2 * at)) as [
      number,
      number,
      number,
      number,
      number,
      number,
    ];
    const memory = this.#copy(this.#wasm.page_memory(VISITORS), SPACE);
    return { af, bc, de, hl, sp, pc, memory, cycles: this.cycles };
  }

  get cycles(): number {
    return this.#wasm.page_cycles(VISITORS);
  }

  /** True when all that was typed has been taken. */
  get idle(): boolean {
    return this.#wasm.page_idle(VISITORS) !== 0;
  }

  /** True when LOAD waits for a tape. */
  get readerEmpty(): boolean {
    return this.#wasm.page_silence(VISITORS) > SILENCE;
  }

  /** The characters printed since the last call. */
  takePaper(): Uint8Array {
    const length = this.#wasm.page_printed(VISITORS);
    return this.#copy(this.#wasm.page_take_paper(VISITORS), length);
  }

  /** The lines that were punched since this was last asked, and the marks between them; a line that is not whole yet stays for
   * the next time. */
  takePunched(): Punched[] {
    const noted = this.#wasm.page_noted(VISITORS);
    const notes = new Float64Array(this.#copy(this.#wasm.page_take_notes(VISITORS), noted).buffer);
    const length = this.#wasm.page_punched(VISITORS);
    const bytes = this.#copy(this.#wasm.page_take_punch(VISITORS), length);
    const found: Punched[] = [];
    let read = 0;
    const upTo = (end: number): void => {
      for (; read < end; read++) {
        const byte = (bytes[read] as number) & 0x7f;
        if (byte !== NEW_LINE) {
          if (byte >= BLANK && byte < RUBOUT) this.#rest.push(byte);
          continue;
        }
        const text = String.fromCharCode(...this.#rest);
        if (text) found.push({ text, ...this.#restOf });
        this.#rest = [];
      }
    };
    for (let note = 0; note < notes.length; note += NOTE) {
      const [at = 0, what = 0, line = 0, x = 0, y = 0] = notes.subarray(note, note + NOTE);
      upTo(at);
      const mark = MARKS[what - 1];
      if (mark) found.push({ mark, from: line });
      else this.#restOf = { line, x, y };
      if (mark) this.#rest = [];
    }
    upTo(bytes.length);
    return found;
  }

  /** A copy of the RAM. */
  save(): Uint8Array {
    return this.#copy(this.#wasm.page_save(VISITORS), RAM_BYTES);
  }

  /** Puts a saved RAM back and pushes the reset button: the firmware keeps program and variables where they are whole. */
  restore(ram: Uint8Array): void {
    this.#wasm.page_restore(VISITORS, this.#give(ram));
    this.reset();
  }

  /** The program that is in a RAM, as LIST prints it. (On a second board: the visitor's one does not notice.) */
  list(ram: Uint8Array): string {
    this.#wasm.page_restore(this.#aside(), this.#give(ram));
    this.#afresh();
    const lines = this.#answer("LIST").split("\r\n");
    return lines
      .slice(1)
      .filter((line) => /^\d/.test(line))
      .map((line) => `${line}\n`)
      .join("");
  }

  /** The lines of a program that the machine does not take, tried on the second board one after the other. A line without a
   * number is a command and is not tried: that is for the page to say. */
  check(program: string): { row: number; error: number; column: number }[] {
    this.#wasm.page_restore(this.#aside(), this.#give(new Uint8Array(RAM_BYTES)));
    this.#afresh();
    return program.split(/\r?\n/).flatMap((line, row) => {
      if (!/^\s*\d/.test(line)) return [];
      const answer = this.#answer(line);
      const error = /(?:^|\n)ERR (\d\d)/.exec(answer)?.[1];
      // (the mark stands below the line as it was typed)
      return error ? [{ row, error: Number(error), column: /\n( *)\^/.exec(answer)?.[1]?.length ?? -1 }] : [];
    });
  }

  /** The second board, made when it is first wanted. */
  #aside(): number {
    if (!this.#scratch) this.#make(SCRATCH);
    this.#scratch = true;
    return SCRATCH;
  }

  /** Resets the second board and lets it come to its prompt. */
  #afresh(): void {
    this.#wasm.page_forget(SCRATCH);
    this.#wasm.page_reset(SCRATCH);
    this.#untilPrompt();
    this.#wasm.page_take_paper(SCRATCH);
  }

  /** Types a line on the second board and returns what it prints. */
  #answer(line: string): string {
    this.#wasm.page_type(SCRATCH, this.#give(bytesOf(`${line}\r`)));
    this.#untilPrompt();
    const length = this.#wasm.page_printed(SCRATCH);
    return ascii(this.#copy(this.#wasm.page_take_paper(SCRATCH), length));
  }

  #untilPrompt(): void {
    const end = this.#wasm.page_cycles(SCRATCH) + PATIENCE;
    while (this.#wasm.page_cycles(SCRATCH) < end && REASONS[this.#wasm.page_run(SCRATCH, 1_000_000)] !== "prompt");
  }

  #make(which: number): void {
    if (!this.#wasm.page_board(which, this.#give(this.#rom))) throw new Error("no memory for the board");
  }

  #give(bytes: Uint8Array): number {
    const at = this.#wasm.page_buffer(bytes.length);
    if (!at) throw new Error("no memory for the board");
    new Uint8Array(this.#wasm.memory.buffer, at, bytes.length).set(bytes);
    return bytes.length;
  }

  #copy(at: number, length: number): Uint8Array<ArrayBuffer> {
    return new Uint8Array(this.#wasm.memory.buffer, at, length).slice();
  }
}

/** Text of bytes below 128; others keep their low seven bits. */
export function ascii(bytes: Uint8Array): string {
  let text = "";
  for (let at = 0; at < bytes.length; at += 8192) {
    text += String.fromCharCode(...bytes.subarray(at, at + 8192).map((byte) => byte & 0x7f));
  }
  return text;
}

/** Bytes of a text; characters beyond ASCII become `?`. */
export function bytesOf(text: string): Uint8Array<ArrayBuffer> {
  return Uint8Array.from(text, (character) => Math.min(character.codePointAt(0) ?? 63, 128)).map((byte) =>
    byte > 126 && byte !== 127 ? 63 : byte,
  );
}
