/** The board under the debugger: it stands, or goes on to a stop or by a step. */
import type { Board, Reason, Step } from "./board.ts";

/** Orders of the debugger: look at the board from now on, hold it, let it go on to a stop or by a step, or leave it. */
export type Move = "look" | "hold" | "go" | "leave" | "over" | "up" | Exclude<Step, "return">;

/** Opcodes that call: CALL, those under a condition, restarts. */
const isCall = (opcode: number): boolean => opcode === 0xcd || (opcode & 0xc7) === 0xc4 || (opcode & 0xc7) === 0xc7;

export class Stepper {
  readonly #board: Board;
  #stops: readonly number[] = [];
  /** The step under way; `stack`: it ends when the stack pointer is above that. */
  #step: { how: Step; stack: number } | undefined;
  /** It runs on behind its step, which only takes it past the stop at which it stands. */
  #runsOn = false;
  /** The debugger is open. */
  isWatched = false;
  isHeld = false;
  /** It is to be held when its present slice of time is over. */
  isHoldWanted = false;

  constructor(board: Board) {
    this.#board = board;
  }

  /** Sets the stops, and how the board is to go on when it is not to stand. */
  begin(how: Move, stops: readonly number[]): void {
    for (const address of this.#stops) this.#board.stopAt(address, false);
    this.#stops = how === "leave" ? [] : stops;
    for (const address of this.#stops) this.#board.stopAt(address, true);
    this.isWatched = how !== "leave";
    if (how === "hold") this.isHoldWanted = true;
    if (how === "hold" || how === "look") return;
    this.free();
    const step = this.#stepOf(how);
    if (!step) return;
    this.#step = step;
    this.#runsOn = false;
  }

  /** The board goes on, past the stop where it stands. */
  free(): void {
    this.#step = this.isHeld ? { how: "instruction", stack: 0 } : undefined;
    this.#runsOn = true;
    this.isHeld = this.isHoldWanted = false;
  }

  hold(): void {
    this.#step = undefined;
    this.isHeld = true;
    this.isHoldWanted = false;
  }

  /** Runs, or takes the step; `break`: the board is to stand. */
  run(cycles: number): Reason {
    if (!this.#step) return this.#board.run(cycles);
    const { how, stack } = this.#step;
    const reason = this.#board.step(how, stack, cycles);
    if (reason !== "break" || !this.#runsOn) return reason;
    this.#step = undefined;
    return this.#board.run(cycles);
  }

  #stepOf(how: Move): { how: Step; stack: number } | undefined {
    const { sp, pc, memory } = this.#board.look();
    if (how === "instruction" || how === "operation") return { how, stack: 0 };
    if (how === "up") return { how: "return", stack: sp };
    if (how !== "over") return undefined;
    return isCall(memory[pc] ?? 0) ? { how: "return", stack: sp - 1 } : { how: "instruction", stack: 0 };
  }
}
