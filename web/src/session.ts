/** The machine as the page has it: what it does now, the program in it, its paper, and what is kept of it. */
import type { Look, Punched } from "./board.ts";
import { ErrorLines } from "./errorline.ts";
import { Machine } from "./machine.ts";
import type { Images, Refused, Speed, State } from "./runner.ts";
import { Keys, type Strange } from "./signs.ts";
import type { Move } from "./stepper.ts";
import { type About, fromBase64, type Kept, type Store, toBase64 } from "./store.ts";
import type { Teletype } from "./teletype.ts";

const CTRL_C = 3;
const NOTHING: Kept = { ram: "", program: "", rom: "", paper: "" };

export interface Hooks {
  state(state: State): void;
  punched(punched: readonly Punched[]): void;
  /** So many characters are on the paper. */
  printed(characters: number): void;
  /** The program in the machine is this, now. */
  memory(program: string): void;
  /** An ERR on the paper; line 0: of a command. */
  error(number: string, line: number): void;
  failed(why: string): void;
  /** Gets the board's registers and memory, for the debugger. */
  look(look: Look, isHeld: boolean): void;
  /** A typed character does not exist on the machine: its line is dropped. */
  strange(strange: Strange): void;
}

export class Session {
  readonly #machine: Machine;
  readonly #teletype: Teletype;
  readonly #store: Store | undefined;
  readonly #hooks: Hooks;
  readonly #keys = new Keys();
  #kept: { ram: string; rom: string } | undefined;
  /** The state kept at the last visit, until the machine reports its own. */
  #last: Kept | null = null;
  state: State = "busy";
  program = "";
  isAlive = true;
  /** The text in the editor, where it is not the program. */
  draft: string | undefined;
  /** The identity of what is written. */
  about: About = {};

  /** Without a store nothing is kept. */
  constructor(worker: string | URL, teletype: Teletype, store: Store | undefined, hooks: Hooks) {
    this.#teletype = teletype;
    this.#store = store;
    this.#hooks = hooks;
    const errors = new ErrorLines((number, line) => hooks.error(number, line));
    this.#machine = new Machine(worker, {
      out: (paper, punched, seen) => {
        teletype.print(paper, seen);
        hooks.printed(paper.length);
        if (punched.length) hooks.punched(punched);
        errors.read(paper);
      },
      state: (state) => {
        this.state = state;
        hooks.state(state);
      },
      memory: (ram, program, rom) => {
        this.program = program;
        this.#kept = { ram: toBase64(ram), rom };
        hooks.memory(program);
        this.keep();
      },
      failed: (why) => {
        this.isAlive = false;
        hooks.failed(why);
      },
      look: (look, isHeld) => hooks.look(look, isHeld),
    });
    addEventListener("pagehide", () => this.keep());
    document.addEventListener("visibilitychange", () => {
      if (document.visibilityState === "hidden") this.keep();
    });
  }

  /** Ctrl-C gets it back to its prompt. */
  get isRunning(): boolean {
    return this.state !== "prompt" && this.state !== "halt";
  }

  /** Starts it with what was kept; false when that is not whole. */
  start(speed: Speed, last: Kept | null, images?: Images): boolean {
    const ram = last ? fromBase64(last.ram) : undefined;
    this.#last = last;
    if (last) this.#teletype.print(last.paper);
    this.#machine.start(speed, last ? { ram, program: last.program, rom: last.rom } : undefined, images);
    return !last || ram !== undefined;
  }

  get kept(): Kept | null {
    const { draft, about } = this;
    // (a text that is written before the machine is there, or without one)
    if (!this.#kept) return draft === undefined ? null : { ...(this.#last ?? NOTHING), draft, about };
    return {
      ...this.#kept,
      program: this.program,
      paper: this.#teletype.paper,
      ...(draft === undefined ? {} : { draft }),
      about,
    };
  }

  keep(): void {
    const { kept } = this;
    if (kept && this.#store) this.#store.machine = kept;
  }

  bringBack(kept: Kept): void {
    const ram = fromBase64(kept.ram);
    this.#teletype.clear();
    this.#teletype.print(kept.paper);
    if (ram) this.#machine.restore(ram, kept.program, kept.rom);
    else this.#machine.load(kept.program, false);
  }

  load(program: string, run: boolean): void {
    this.#machine.load(program, run);
  }

  check(program: string): Promise<Refused[]> {
    return this.isAlive ? this.#machine.check(program) : Promise.resolve([]);
  }

  run(): void {
    this.#machine.type("RUN\r");
  }

  stop(): void {
    this.press(CTRL_C);
  }

  /** Types at the machine's pace; a line with a character that it has not is dropped, and said. */
  type(text: string): void {
    const { sent, strange } = this.#keys.feed(text);
    for (const each of strange) this.#hooks.strange(each);
    this.#machine.type(sent);
  }

  press(key: number): void {
    if (key === CTRL_C) this.#keys.drop();
    this.#machine.press(key);
  }

  debug(how: Move, stops: readonly number[]): void {
    this.#machine.debug(how, stops);
  }

  reset(): void {
    this.#keys.drop();
    this.#machine.reset();
  }

  speed(speed: Speed): void {
    this.#machine.speed(speed);
  }
}
