/** The page's side of the board's worker. */
import { bytesOf, type Look, type Punched } from "./board.ts";
import type { Images, News, Order, Refused, Speed, State } from "./runner.ts";
import type { Move } from "./stepper.ts";

export interface Listener {
  /** `seen` is to be called when all of it has been shown: the board waits for that. */
  out(paper: string, punched: Punched[], seen: () => void): void;
  state(state: State): void;
  memory(ram: Uint8Array, program: string, rom: string): void;
  failed(why: string): void;
  /** The board's registers and memory, for the debugger; `isHeld`: the board stands until it is told to go on. */
  look(look: Look, isHeld: boolean): void;
}

export class Machine {
  readonly #worker: Worker;
  readonly #listener: Listener;
  /** The number of loads, restores and resets: older news are dropped. */
  #taken = 0;
  #asked = 0;
  readonly #answers = new Map<number, (refused: Refused[]) => void>();

  constructor(address: string | URL, listener: Listener) {
    this.#listener = listener;
    this.#worker = new Worker(address);
    this.#worker.onmessage = (event: MessageEvent<News>) => this.#hear(event.data);
    this.#worker.onerror = (event) => listener.failed(event.message || "worker");
  }

  start(speed: Speed, kept?: { ram: Uint8Array | undefined; program: string; rom: string }, images?: Images): void {
    this.#say({
      kind: "start",
      speed,
      ...(images ? { images } : {}),
      ...(kept ? { program: kept.program, rom: kept.rom, ...(kept.ram ? { ram: kept.ram } : {}) } : {}),
    });
  }

  /** Types at the machine's pace: a character goes in when the board asks for one. */
  type(text: string): void {
    this.#say({ kind: "type", bytes: bytesOf(text.replace(/\r?\n/g, "\r")) });
  }

  /** Presses a key now, whatever waits to be typed. */
  press(key: number): void {
    this.#say({ kind: "press", key });
  }

  /** NEW (`clear`), LOAD and RUN of a program; what runs is broken off. */
  load(program: string, run: boolean, clear = true): void {
    this.#take({ kind: "load", program, run, clear });
  }

  /** Puts a saved RAM back; the program alone where it belongs to another ROM. */
  restore(ram: Uint8Array, program: string, rom: string): void {
    this.#take({ kind: "restore", ram, program, rom });
  }

  /** The lines of a text that the machine would not take; what is in it stays there. */
  check(program: string): Promise<Refused[]> {
    const id = ++this.#asked;
    this.#say({ kind: "check", id, program });
    return new Promise((answer) => this.#answers.set(id, answer));
  }

  reset(): void {
    this.#take({ kind: "reset" });
  }

  speed(speed: Speed): void {
    this.#say({ kind: "speed", speed });
  }

  debug(how: Move, stops: readonly number[]): void {
    this.#say({ kind: "debug", how, stops });
  }

  #take(order: Order): void {
    this.#taken++;
    this.#say(order);
    this.#listener.state("busy");
  }

  #say(order: Order): void {
    this.#worker.postMessage(order);
  }

  #hear(news: News): void {
    switch (news.kind) {
      case "out":
        this.#listener.out(news.paper, news.punched, () => this.#say({ kind: "seen" }));
        this.#listener.state(news.taken === this.#taken ? news.state : "busy");
        break;
      case "memory":
        // (what was there before a load says nothing of what was loaded)
        if (news.taken === this.#taken) this.#listener.memory(news.ram, news.program, news.rom);
        break;
      case "checked":
        this.#answers.get(news.id)?.(news.refused);
        this.#answers.delete(news.id);
        break;
      case "look":
        this.#listener.look(news.look, news.isHeld);
        break;
      case "failed":
        this.#listener.failed(news.why);
        break;
    }
  }
}
