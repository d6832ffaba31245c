/** The worker in which the board runs: the page never waits for it, whatever is typed or pasted. */
import { ascii, Board, bytesOf, readNames, type Punched, type Reason } from "./board.ts";

export type Speed = "real" | "fast";

/** What the page says. */
export type Order =
  | { kind: "start"; ram?: Uint8Array; program?: string; rom?: string; speed: Speed }
  | { kind: "type"; bytes: Uint8Array }
  | { kind: "press"; key: number }
  | { kind: "tape"; bytes: Uint8Array }
  | { kind: "load"; program: string; run: boolean; clear: boolean }
  | { kind: "restore"; ram: Uint8Array; program: string; rom: string }
  | { kind: "reset" }
  | { kind: "speed"; speed: Speed }
  | { kind: "seen" };

/** What the board does now; `tape`: LOAD waits for one. */
export type State = "busy" | "prompt" | "input" | "wait" | "tape" | "halt";

/** What the worker says. `taken`: how often it was loaded, restored or reset until then. `memory`: at a prompt, when the RAM has
 * changed; `rom` names the ROM that it belongs to. */
export type News =
  | { kind: "out"; paper: string; punched: Punched[]; state: State; taken: number; cycles: number }
  | { kind: "memory"; ram: Uint8Array; program: string; rom: string }
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

let board: Board;
let rom = "";
let speed: Speed = "fast";
let state: State = "busy";
let asleep = true;
let unseen = 0;
let kept: Uint8Array = new Uint8Array(0);
let keptProgram = "";
/** When it was last at its prompt or had something left to type; whether the program that runs since has been looked at. */
let quiet = 0;
let looked = false;
/** What is to be done at the next prompts, unless there is an ERR on the way. */
let script: (() => void)[] = [];
let errors = "";
/** A ctrl-C that makes room for the script has been pressed: its ERR 10 is none of the script's. */
let broken = false;
/** It has not been at its prompt since it was switched on or reset: nothing runs that could be broken off. */
let isStarting = true;
let taken = 0;
let last = 0;

const tell = (news: News): void => postMessage(news);

const channel = new MessageChannel();
channel.port1.onmessage = () => turn();

function wake(): void {
  if (!asleep) return;
  asleep = false;
  last = performance.now();
  schedule();
}

function schedule(): void {
  if (speed === "real") setTimeout(turn, TICK);
  else channel.port2.postMessage(0);
}

/** Lets the board run for a while, and tells what came of it. */
function turn(): void {
  if (asleep) return;
  if (unseen > UNSEEN) {
    asleep = true; // until `seen`
    return;
  }
  const now = performance.now();
  const due = speed === "real" ? (Math.min(now - last, 250) * HZ) / 1000 : SLICE;
  last = now;
  const reason = board.run(Math.max(1, due));
  state = stateOf(reason);
  const paper = ascii(board.takePaper());
  const punched = board.takePunched();
  errors = (errors + paper).slice(-400);
  if (state === "prompt" && !broken && /(^|\n)ERR \d\d/.test(errors)) script = [];
  if (paper || punched.length || state !== "busy") report(paper, punched);
  if (state === "prompt") atPrompt();
  else if (state !== "halt") inRun(now);
  if (state === "busy" || !board.idle) schedule();
  else asleep = true;
}

function report(paper: string, punched: Punched[]): void {
  unseen++;
  // (At the prompts of its script it waits for nobody.)
  tell({ kind: "out", paper, punched, state: state === "prompt" && script.length ? "busy" : state, taken, cycles: board.cycles });
}

function stateOf(reason: Reason): State {
  if (reason === "cycles") return board.readerEmpty ? "tape" : "busy";
  if (reason === "break" || reason === "nobody") return "halt";
  return reason;
}

function atPrompt(): void {
  broken = isStarting = looked = false;
  quiet = performance.now();
  const next = script.shift();
  if (next) {
    errors = "";
    next();
  } else {
    remember();
  }
}

/** Tells the page the memory when it has changed. */
function remember(): void {
  const ram = board.save();
  if (ram.length === kept.length && ram.every((byte, at) => byte === kept[at])) return;
  keep(ram, board.list(ram));
}

function keep(ram: Uint8Array, program: string): void {
  kept = ram;
  keptProgram = program;
  tell({ kind: "memory", ram, program, rom });
}

/** A program that was typed and RUN in one go is in no memory that the page was told: it is told that while it runs. */
function inRun(now: number): void {
  if (!board.idle) {
    quiet = now;
    looked = false;
  } else if (!looked && !isStarting && (state !== "busy" || now - quiet > RUNS)) {
    looked = true;
    const ram = board.save();
    const program = board.list(ram);
    if (program !== keptProgram) keep(ram, program);
  }
}

/** Carries out a script from the next prompt on: now, when the board stands at one; else what runs is broken off. */
function carryOut(steps: (() => void)[]): void {
  board.forget();
  errors = "";
  script = steps;
  if (state === "prompt") {
    atPrompt();
  } else {
    broken = true;
    if (!isStarting) board.press(CTRL_C);
    wake();
  }
}

const typed = (text: string) => (): void => {
  board.type(bytesOf(text));
  wake();
};

async function start(order: Order & { kind: "start" }): Promise<void> {
  const at = (name: string): URL => new URL(name, self.location.href);
  const get = async (name: string): Promise<ArrayBuffer> => {
    const answer = await fetch(at(name));
    if (!answer.ok) throw new Error(`${name}: ${answer.status}`);
    return answer.arrayBuffer();
  };
  const [code, image, sym] = await Promise.all(["board.wasm", "skg.bin", "skg.sym"].map(get));
  const module = await WebAssembly.compile(code as ArrayBuffer);
  const names = readNames(ascii(new Uint8Array(sym as ArrayBuffer)));
  const bytes = new Uint8Array(image as ArrayBuffer);
  rom = nameOf(bytes);
  board = await Board.create(module, bytes, names);
  setSpeed(order.speed);
  if (order.ram && order.rom === rom) board.restore(order.ram);
  else if (order.program) script = loading(order.program, false, false);
  ready = true;
  for (const waiting of early.splice(0)) obey(waiting);
  wake();
}

function loading(program: string, run: boolean, clear: boolean): (() => void)[] {
  return [
    ...(clear ? [typed("NEW\r")] : []),
    () => {
      board.tape(bytesOf(program.endsWith("\n") ? program : `${program}\n`));
      typed("LOAD\r")();
    },
    ...(run ? [typed("RUN\r")] : []),
  ];
}

function setSpeed(wanted: Speed): void {
  speed = wanted;
  board.baud(speed === "real" ? BAUD : 0);
}

/** A short name of an image: two are told apart by it. */
function nameOf(image: Uint8Array): string {
  let hash = 0x811c9dc5;
  for (const byte of image) hash = Math.imul(hash ^ byte, 0x01000193);
  return (hash >>> 0).toString(16);
}

let ready = false;
const early: Order[] = [];

function obey(order: Order): void {
  switch (order.kind) {
    case "start":
      start(order).catch((error: unknown) => tell({ kind: "failed", why: String(error) }));
      return;
    case "type":
      board.type(order.bytes);
      break;
    case "press":
      if (order.key === CTRL_C) script = [];
      board.press(order.key);
      break;
    case "tape":
      board.tape(order.bytes);
      break;
    case "load":
      taken++;
      carryOut(loading(order.program, order.run, order.clear));
      break;
    case "restore":
      taken++;
      if (order.rom !== rom) {
        carryOut(loading(order.program, false, true));
        break;
      }
      script = [];
      board.forget();
      board.restore(order.ram);
      isStarting = true;
      break;
    case "reset":
      taken++;
      script = [];
      board.forget();
      board.reset();
      isStarting = true;
      break;
    case "speed":
      setSpeed(order.speed);
      return;
    case "seen":
      unseen--;
      if (state !== "busy" && board.idle) return;
      break;
  }
  wake();
}

onmessage = (event: MessageEvent<Order>) => {
  if (ready || event.data.kind === "start") obey(event.data);
  else early.push(event.data);
};
