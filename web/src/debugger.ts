/** The debugger of `skg80 --debug` in the page: where the board is in the ROM, its registers, the float stack, memory; step and
 * stop. Loaded when it is first wanted. */
import type { Look } from "./board.ts";
import { Calculator, general } from "./calculator.ts";
import { make } from "./dom.ts";
import { t, type Word } from "./language.ts";
import { instructions } from "./listing.ts";
import type { Move } from "./stepper.ts";
import { hex, Symbols } from "./symbols.ts";

const LINES = 14;
const OPERATIONS = 8;
const ROW = 8;
const ROWS = 8;
/** Words of the processor's stack. */
const CALLS = 8;
const FLAGS = [
  ["S", 0x80],
  ["Z", 0x40],
  ["A", 0x10],
  ["P", 0x04],
  ["C", 0x01],
] as const;
const MOVES: readonly (readonly [Move, Word])[] = [
  ["hold", "hold"],
  ["go", "goOn"],
  ["instruction", "stepInstruction"],
  ["over", "stepOver"],
  ["up", "stepUp"],
  ["operation", "stepOperation"],
];

export class Debugger {
  readonly #symbols: Symbols;
  readonly #calculator: Calculator;
  readonly #debug: (how: Move, stops: readonly number[]) => void;
  readonly #stops = new Set<number>();
  readonly #place = make("p", "place");
  readonly #registers = make("div", "registers");
  readonly #code = make("ol", "code");
  readonly #calls = make("p", "calls");
  readonly #floats = make("p", "floats");
  readonly #operations = make("ol", "code");
  readonly #named = make("div", "registers");
  readonly #memory = make("pre", "");
  readonly #stopList = make("ul", "stops");
  readonly #address = make("input", "");
  #look: Look | undefined;
  #isHeld = false;

  /** Fills the box; `debug` tells the board what to do. */
  constructor(box: HTMLElement, sym: string, debug: (how: Move, stops: readonly number[]) => void) {
    this.#symbols = new Symbols(sym);
    this.#calculator = new Calculator(this.#symbols);
    this.#debug = debug;
    const bar = make("div", "bar");
    for (const [how, word] of MOVES) bar.append(button(word, () => this.#move(how), how));
    this.#place.setAttribute("role", "status");
    this.#address.value = "MREG";
    this.#memory.tabIndex = 0;
    box.replaceChildren(
      bar,
      this.#place,
      this.#registers,
      heading("code"),
      this.#code,
      heading("calls"),
      this.#calls,
      heading("calculator"),
      this.#floats,
      this.#operations,
      this.#named,
      heading("memory"),
      this.#entry(this.#address, "memoryFrom", () => this.#showMemory()),
      this.#memory,
      heading("stops"),
      this.#entry(make("input", ""), "stopAt", (address, input) => {
        this.#toggle(address);
        input.value = "";
      }),
      this.#stopList,
    );
  }

  /** Looks at the board from now on; the stops of last time are in force again. */
  begin(): void {
    this.#debug("look", [...this.#stops]);
  }

  /** Shows the board's present state. */
  show(look: Look, isHeld: boolean): void {
    this.#look = look;
    this.#isHeld = isHeld;
    this.say();
  }

  /** Writes all of it, in the present language. */
  say(): void {
    const look = this.#look;
    if (!look) return;
    const { pc, memory, cycles } = look;
    // (who sets a stop by the keyboard stays where he is)
    const focused = (document.activeElement as HTMLElement | null)?.dataset["address"];
    const file = this.#symbols.file(pc);
    const words = [t(this.#isHeld ? "held" : "passes"), this.#symbols.place(pc), file ? `asm/${file}.asm` : ""];
    this.#place.textContent = `${words.filter(Boolean).join(" · ")} · ${t("cycles", cycles)}`;
    this.#registers.replaceChildren(...registersOf(look));
    const code = instructions(this.#symbols, this.#calculator, memory, pc, LINES).slice(0, LINES);
    this.#code.replaceChildren(...code.map(({ address, text }) => this.#row(address, text, pc)));
    this.#calls.textContent = this.#callers(look).join(" ← ") || "–";
    const floats = this.#calculator.stack(memory);
    this.#floats.textContent = t("floats", floats?.map(general).join("  ") || "–");
    const isAt = pc === this.#calculator.next;
    this.#operations.hidden = !isAt;
    if (isAt) {
      const { lines } = this.#calculator.listing(memory, look.bc, OPERATIONS);
      this.#operations.replaceChildren(...lines.map(({ address, text }) => this.#row(address, text, look.bc)));
    }
    this.#named.replaceChildren(...this.#calculator.registers(memory).map(({ names, value }) => pair(names, general(value))));
    this.#showMemory();
    this.#showStops();
    if (focused) this.#code.querySelector<HTMLElement>(`[data-address="${focused}"]`)?.focus();
  }

  #move(how: Move): void {
    if (how !== "hold") this.#place.textContent = t("busy");
    this.#debug(how, [...this.#stops]);
  }

  #toggle(address: number): void {
    if (!this.#stops.delete(address)) this.#stops.add(address);
    this.#debug("look", [...this.#stops]);
  }

  /** A field for an address or a label. */
  #entry(input: HTMLInputElement, word: Word, use: (address: number, input: HTMLInputElement) => void): HTMLElement {
    const form = make("form", "bar");
    const label = make("label", "");
    const name = make("span", "", t(word));
    name.dataset["t"] = word;
    Object.assign(input, { type: "text", size: 12, spellcheck: false, autocapitalize: "characters" });
    label.append(name, input);
    form.append(
      label,
      button("enterAddress", () => undefined),
    );
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      const address = this.#symbols.address(input.value);
      input.setCustomValidity(address === undefined ? t("noPlace", input.value) : "");
      if (address === undefined) input.reportValidity();
      else use(address, input);
    });
    input.addEventListener("input", () => input.setCustomValidity(""));
    return form;
  }

  #row(address: number, text: string, present: number): HTMLElement {
    const row = make("li", address === present ? "present" : "");
    const mark = button("stopHere", () => this.#toggle(address));
    mark.removeAttribute("data-t");
    mark.dataset["address"] = hex(address);
    mark.ariaPressed = String(this.#stops.has(address));
    mark.ariaLabel = t("stopHere", this.#symbols.place(address));
    mark.textContent = "●";
    row.append(mark, make("span", "number", hex(address)), make("b", "", this.#symbols.place(address)), make("span", "", text));
    return row;
  }

  /** Routines whose return addresses stand on the processor's stack; what stands there may be data, too. */
  #callers({ sp, memory }: Look): string[] {
    const top = this.#symbols.value("STKTOP") ?? sp;
    const places: string[] = [];
    for (let at = sp; at + 1 < top && places.length < CALLS; at += 2) {
      const word = (memory[at] ?? 0) | ((memory[at + 1] ?? 0) << 8);
      // (behind a CALL, or a restart)
      const isBehindCall = [0xcd, 0xc4, 0xcc, 0xd4, 0xdc, 0xe4, 0xec, 0xf4, 0xfc].includes(memory[word - 3] ?? 0);
      if (this.#symbols.file(word) && isBehindCall) places.push(this.#symbols.place(word));
    }
    return places;
  }

  #showMemory(): void {
    const from = this.#symbols.address(this.#address.value);
    const { memory } = this.#look ?? {};
    if (from === undefined || !memory) return;
    const rows = Array.from({ length: ROWS }, (_, row) => {
      const at = (from + ROW * row) & 0xffff;
      const bytes = Array.from({ length: ROW }, (_, column) => memory[(at + column) & 0xffff] ?? 0);
      const text = bytes.map((byte) => (byte >= 0x20 && byte < 0x7f ? String.fromCharCode(byte) : ".")).join("");
      return `${hex(at)}  ${bytes.map((byte) => hex(byte, 2)).join(" ")}  ${text}`;
    });
    this.#memory.textContent = rows.join("\n");
  }

  #showStops(): void {
    this.#stopList.replaceChildren(
      ...[...this.#stops].map((address) => {
        const row = make("li", "");
        const bin = button("deleteWork", () => this.#toggle(address));
        bin.removeAttribute("data-t");
        bin.textContent = "✕";
        bin.ariaLabel = t("deleteWork", this.#symbols.place(address));
        row.append(`${hex(address)} ${this.#symbols.place(address)} `, bin);
        return row;
      }),
    );
  }
}

function registersOf({ af, bc, de, hl, sp, pc }: Look): HTMLElement[] {
  const flags = FLAGS.map(([name, bit]) => (af & bit ? name : ".")).join("");
  const words = { BC: bc, DE: de, HL: hl, SP: sp, PC: pc };
  return [pair("A", hex(af >> 8, 2)), pair("F", flags), ...Object.entries(words).map(([name, value]) => pair(name, hex(value)))];
}

function pair(name: string, value: string): HTMLElement {
  const box = make("span", "");
  box.append(make("b", "", name), ` ${value}`);
  return box;
}

function heading(word: Word): HTMLElement {
  const element = make("h3", "", t(word));
  element.dataset["t"] = word;
  return element;
}

function button(word: Word, action: () => void, name = ""): HTMLButtonElement {
  const element = make("button", "", t(word));
  element.dataset["t"] = word;
  if (name) element.dataset["move"] = name;
  element.addEventListener("click", action);
  element.type = name || word === "stopHere" || word === "deleteWork" ? "button" : "submit";
  return element;
}
