/** Runs the board in its worker: what is to be done at its prompts, and what the page is told. */
import { ascii, Board, bytesOf, type Look, type Punched, type Reason, readNames } from "./board.ts";
import { type Move, Stepper } from "./stepper.ts";

export type Speed = "real" | "fast";

/** The files of the machine; without them the worker fetches them from its own folder. */
export interface Images {
  code: ArrayBuffer;
  rom: ArrayBuffer;
  sym: ArrayBuffer;
}

/** Orders of the page. */
export type Order =
  | { kind: "start"; ram?: Uint8Array; program?: string; rom?: string; speed: Speed; images?: Images }
  | { kind: "type"; bytes: Uint8Array }
  | { kind: "press"; key: number }
  | { kind: "tape"; bytes: Uint8Array }
  | { kind: "load"; program: string; run: boolean; clear: boolean }
  | { kind: "restore"; ram: Uint8Array; program: string; rom: string }
  | { kind: "check"; id: number; program: string }
  | { kind: "reset" }
  | { kind: "speed"; speed: Speed }
  | { kind: "debug"; how: Move; stops: readonly number[] }
  | { kind: "seen" };

/** The board's state; `tape`: LOAD waits for one; `held`: the debugger holds it. */
export type State = "busy" | "prompt" | "input" | "wait" | "tape" | "halt" | "held";

/** A line of a text that the machine does not take: its place in the text from 0, the ERR, the column of the mark or -1. */
export interface Refused {
  row: number;
  error: number;
  column: number;
}

/** News of the worker. `taken`: the number of loads, restores and resets until then. `memory`: at a prompt, when the RAM has
 * changed; `rom` names the ROM that it belongs to. */
export type News =
  | { kind: "out"; paper: string; punched: Punched[]; state: State; taken: number; cycles: number }
  | { kind: "memory"; ram: Uint8Array; program: string; rom: string; taken: number }
  | { kind: "checked"; id: number; refused: Refused[] }
  | { kind: "look"; look: Look; isHeld: boolean }
  | { kind: "failed"; why: string };

/** The board's clock, and the teletype's line, as they were. */
const HZ = 2_000_000;
const BAUD = 110;
/** Cycles between two looks at the paper; so many pieces of news may wait to be seen. */
const SLICE = 2_000_000;
const UNSEEN = 6;
const TICK = 15;
/** ms without a prompt, and with nothing left to type, from which on a program runs; no line takes so long to store. */
const RUNS = 400;
const CTRL_C = 3;

export class Runner {
  #board!: Board;
  #rom = "";
  #speed: Speed = "fast";
  #state: State = "busy";
  #asleep = true;
  #unseen = 0;
  #kept: Uint8Array = new Uint8Array(0);
  #keptProgram = "";
  /** The last time it was at its prompt or had characters left to type; whether the program running since has been looked at. */
  #quiet = 0;
  #looked = false;
  /** Steps to take at the next prompts; an ERR drops them. */
  #script: (() => void)[] = [];
  #errors = "";
  /** A ctrl-C has been pressed for the script to begin: its ERR 10 is none of the script's. */
  #broken = false;
  /** It has not been at its prompt since it was switched on or reset: no program runs. */
  #isStarting = true;
  #taken = 0;
  #last = 0;
  #isReady = false;
  #stepper!: Stepper;
  readonly #early: Order[] = [];
  readonly #channel = new MessageChannel();
  readonly #tell: (news: News) => void;

  constructor(tell: (news: News) => void) {
    this.#tell = tell;
    this.#channel.port1.onmessage = () => this.#turn();
  }

  hear(order: Order): void {
    if (this.#isReady || order.kind === "start") this.#obey(order);
    else this.#early.push(order);
  }

  #obey(order: Order): void {
    switch (order.kind) {
      case "start":
        this.#start(order).catch((error: unknown) => this.#tell({ kind: "failed", why: String(error) }));
        return;
      case "check":
        this.#tell({ kind: "checked", id: order.id, refused: this.#board.check(order.program) });
        return;
      case "type":
        this.#board.type(order.bytes);
        break;
      case "press":
        if (order.key === CTRL_C) {
          this.#script = [];
          this.#stepper.free();
        }
        this.#board.press(order.key);
        break;
      case "tape":
        this.#board.tape(order.bytes);
        break;
      case "load":
        this.#taken++;
        this.#carryOut(this.#loading(order.program, order.run, order.clear));
        break;
      case "restore":
        this.#taken++;
        if (order.rom !== this.#rom) {
          this.#carryOut(this.#loading(order.program, false, true));
          break;
        }
        this.#again(() => this.#board.restore(order.ram));
        break;
      case "reset":
        this.#taken++;
        this.#again(() => this.#board.reset());
        break;
      case "speed":
        this.#setSpeed(order.speed);
        return;
      case "debug":
        this.#debug(order.how, order.stops);
        return;
      case "seen":
        this.#unseen--;
        if (this.#state !== "busy" && this.#board.idle) return;
        break;
    }
    this.#wake();
  }

  #debug(how: Move, stops: readonly number[]): void {
    const { isHeld } = this.#stepper;
    this.#stepper.begin(how, stops);
    if (how === "look") {
      this.#show();
    } else if (how !== "hold") {
      this.#state = "busy";
      if (isHeld) this.#report("", []);
      this.#wake();
    } else if (this.#asleep && !isHeld) {
      this.#hold();
    }
  }

  #hold(): void {
    this.#stepper.hold();
    this.#asleep = true;
    this.#state = "held";
    this.#report(ascii(this.#board.takePaper()), this.#board.takePunched());
  }

  #show(): void {
    const { isWatched, isHeld } = this.#stepper;
    if (isWatched) this.#tell({ kind: "look", look: this.#board.look(), isHeld });
  }

  #again(begin: () => void): void {
    this.#script = [];
    this.#stepper.free();
    this.#board.forget();
    begin();
    this.#isStarting = true;
  }

  async #start(order: Order & { kind: "start" }): Promise<void> {
    const get = async (name: string): Promise<ArrayBuffer> => {
      const answer = await fetch(new URL(name, self.location.href));
      if (!answer.ok) throw new Error(`${name}: ${answer.status}`);
      return answer.arrayBuffer();
    };
    const images = order.images;
    const [code, image, sym] = images
      ? [images.code, images.rom, images.sym]
      : ((await Promise.all(["board.wasm", "skg.bin", "skg.sym"].map(get))) as [ArrayBuffer, ArrayBuffer, ArrayBuffer]);
    const bytes = new Uint8Array(image);
    this.#rom = nameOf(bytes);
    this.#board = await Board.create(await WebAssembly.compile(code), bytes, readNames(ascii(new Uint8Array(sym))));
    this.#stepper = new Stepper(this.#board);
    this.#setSpeed(order.speed);
    if (order.ram && order.rom === this.#rom) this.#board.restore(order.ram);
    else if (order.program) this.#script = this.#loading(order.program, false, false);
    this.#isReady = true;
    for (const waiting of this.#early.splice(0)) this.#obey(waiting);
    this.#wake();
  }

  #wake(): void {
    if (!this.#asleep || this.#stepper.isHeld) return;
    this.#asleep = false;
    this.#last = performance.now();
    this.#schedule();
  }

  #schedule(): void {
    if (this.#speed === "real") setTimeout(() => this.#turn(), TICK);
    else this.#channel.port2.postMessage(0);
  }

  /** Lets the board run for a while, and tells what came of it. */
  #turn(): void {
    if (this.#asleep) return;
    if (this.#unseen > UNSEEN) {
      this.#asleep = true; // until `seen`
      return;
    }
    const board = this.#board;
    const now = performance.now();
    const due = this.#speed === "real" ? (Math.min(now - this.#last, 250) * HZ) / 1000 : SLICE;
    this.#last = now;
    const reason = this.#stepper.run(Math.max(1, due));
    if (reason === "break" || this.#stepper.isHoldWanted) {
      this.#hold();
      return;
    }
    this.#state = this.#stateOf(reason);
    const paper = ascii(board.takePaper());
    const punched = board.takePunched();
    this.#errors = (this.#errors + paper).slice(-400);
    if (this.#state === "prompt" && !this.#broken && /(^|\n)ERR \d\d/.test(this.#errors)) this.#script = [];
    if (paper || punched.length || this.#state !== "busy") this.#report(paper, punched);
    if (this.#state === "prompt") this.#atPrompt();
    else if (this.#state !== "halt") this.#inRun(now);
    if (this.#state === "busy" || !board.idle) this.#schedule();
    else this.#asleep = true;
  }

  #report(paper: string, punched: Punched[]): void {
    this.#unseen++;
    // (At the prompts of its script it waits for nobody.)
    const state = this.#state === "prompt" && this.#script.length ? "busy" : this.#state;
    this.#tell({ kind: "out", paper, punched, state, taken: this.#taken, cycles: this.#board.cycles });
    if (state !== "busy") this.#show();
  }

  #stateOf(reason: Reason): State {
    if (reason === "cycles") return this.#board.readerEmpty ? "tape" : "busy";
    if (reason === "break" || reason === "nobody") return "halt";
    return reason;
  }

  #atPrompt(): void {
    this.#broken = this.#isStarting = this.#looked = false;
    this.#quiet = performance.now();
    const next = this.#script.shift();
    if (next) {
      this.#errors = "";
      next();
    } else {
      this.#remember();
    }
  }

  /** Tells the page the memory when it has changed. */
  #remember(): void {
    const ram = this.#board.save();
    if (ram.length === this.#kept.length && ram.every((byte, at) => byte === this.#kept[at])) return;
    this.#keep(ram, this.#board.list(ram));
  }

  #keep(ram: Uint8Array, program: string): void {
    this.#kept = ram;
    this.#keptProgram = program;
    this.#tell({ kind: "memory", ram, program, rom: this.#rom, taken: this.#taken });
  }

  /** A program that was typed and RUN in one go is in no memory that the page was told: it is told that while it runs. */
  #inRun(now: number): void {
    if (!this.#board.idle) {
      this.#quiet = now;
      this.#looked = false;
    } else if (!this.#looked && !this.#isStarting && (this.#state !== "busy" || now - this.#quiet > RUNS)) {
      this.#looked = true;
      const ram = this.#board.save();
      const program = this.#board.list(ram);
      if (program !== this.#keptProgram) this.#keep(ram, program);
    }
  }

  /** Carries out a script from the next prompt on: now, when the board stands at one; else what runs is broken off. */
  #carryOut(steps: (() => void)[]): void {
    this.#stepper.free();
    this.#board.forget();
    this.#errors = "";
    this.#script = steps;
    if (this.#state === "prompt") {
      this.#atPrompt();
    } else {
      this.#broken = true;
      if (!this.#isStarting) this.#board.press(CTRL_C);
      this.#wake();
    }
  }

  #typed(text: string): () => void {
    return () => {
      this.#board.type(bytesOf(text));
      this.#wake();
    };
  }

  #loading(program: string, run: boolean, clear: boolean): (() => void)[] {
    return [
      ...(clear ? [this.#typed("NEW\r")] : []),
      () => {
        this.#board.tape(bytesOf(program.endsWith("\n") ? program : `${program}\n`));
        this.#typed("LOAD\r")();
      },
      ...(run ? [this.#typed("RUN\r")] : []),
    ];
  }

  #setSpeed(wanted: Speed): void {
    this.#speed = wanted;
    this.#board.baud(wanted === "real" ? BAUD : 0);
  }
}

/** A short name of an image: two are told apart by it. */
function nameOf(image: Uint8Array): string {
  let hash = 0x811c9dc5;
  for (const byte of image) hash = Math.imul(hash ^ byte, 0x01000193);
  return (hash >>> 0).toString(16);
}
