/** The machine's inside, beside the page: the debugger, which is loaded when it is first wanted. */
import type { Look } from "./board.ts";
import type { Debugger } from "./debugger.ts";
import { get } from "./dom.ts";
import { say } from "./message.ts";
import { openPane } from "./pane.ts";
import { readModule, readSymbols } from "./pieces.ts";
import type { Session } from "./session.ts";

export class Inside {
  #debugger: Debugger | undefined;

  async open(session: Session): Promise<void> {
    if (!this.#debugger) {
      try {
        const [{ Debugger }, module, sym] = await Promise.all([
          import("./debugger.ts"),
          readModule("inside.wasm"),
          readSymbols(),
        ]);
        this.#debugger = await Debugger.create(get("inside"), module, sym, (how, stops) => session.debug(how, stops));
      } catch {
        say("noDebugger");
        return;
      }
    }
    openPane("machine-pane", () => session.debug("leave", []));
    this.#debugger.begin();
  }

  look(look: Look, isHeld: boolean): void {
    this.#debugger?.show(look, isHeld);
  }

  /** Writes it in another language. */
  retell(): void {
    this.#debugger?.say();
  }
}
