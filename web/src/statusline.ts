/** The machine's state in words, and the meaning of the button RUN. */

import { get, tell } from "./dom.ts";
import { t, type Word } from "./language.ts";
import type { State } from "./runner.ts";
import { view } from "./shell.ts";
import type { Teletype } from "./teletype.ts";
import type { Workbench } from "./workbench.ts";

const STATES: Record<State, Word> = {
  busy: "busy",
  prompt: "prompt",
  input: "input",
  wait: "wait",
  tape: "waitTape",
  halt: "halt",
  held: "heldState",
};

export class StatusLine {
  readonly #bench: Workbench;
  readonly #teletype: Teletype;
  #said: Word | undefined;

  constructor(bench: Workbench, teletype: Teletype) {
    this.#bench = bench;
    this.#teletype = teletype;
  }

  /** Shows a state; at an INPUT by hand the keys go to the teletype. */
  show(state: State): void {
    const { session, isByHand } = this.#bench;
    const word = STATES[state];
    get("run").textContent = t(session.isRunning ? "stop" : "run");
    if (word === this.#said) return;
    this.#said = word;
    tell(get("state"), session.isAlive ? t(word) : "");
    if (state === "input" && isByHand) {
      view("teletype");
      this.#teletype.focus();
    }
  }

  /** Writes it in another language. */
  retell(): void {
    this.#said = undefined;
    this.show(this.#bench.session.state);
  }
}
