/** The debugger of `skg80 --debug` in the page: where the board is in the ROM, its registers, the float stack, memory; step and
 * stop. Loaded when it is first wanted. */
import type { Look } from "./board.ts";
import { make } from "./dom.ts";
import { Firmware, hex, type Line } from "./firmware.ts";
import { t, type Word } from "./language.ts";
import type { Move } from "./stepper.ts";

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
  readonly #firmware: Firmware;
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

  private constructor(box: HTMLElement, firmware: Firmware, debug: (how: Move, stops: readonly number[]) => void) {
    this.#firmware = firmware;
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

  /** Fills the box. `module` is inside.wasm, `sym` roms/skg.sym; `debug` tells the board what to do. */
  static async create(
    box: HTMLElement,
    module: WebAssembly.Module,
    sym: string,
    debug: (how: Move, stops: readonly number[]) => void,
  ): Promise<Debugger> {
    return new Debugger(box, await Firmware.create(module, sym), debug);
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
    const { pc, bc, memory, cycles } = look;
    this.#firmware.look(memory);
    // (who sets a stop by the keyboard stays where he is)
    const focused = (document.activeElement as HTMLElement | null)?.dataset["address"];
    const file = this.#firmware.file(pc);
    const words = [t(this.#isHeld ? "held" : "passes"), this.#firmware.place(pc), file ? `asm/${file}.asm` : ""];
    this.#place.textContent = `${words.filter(Boolean).join(" · ")} · ${t("cycles", cycles)}`;
    this.#registers.replaceChildren(...registersOf(look));
    const code = this.#firmware.listing(pc, LINES).slice(0, LINES);
    this.#code.replaceChildren(...code.map((line) => this.#row(line, pc)));
    this.#calls.textContent = this.#callers(look).join(" ← ") || "–";
    this.#floats.textContent = t("floats", this.#firmware.floats().join("  ") || "–");
    const isAt = pc === this.#firmware.value("CALC1");
    this.#operations.hidden = !isAt;
    if (isAt) this.#operations.replaceChildren(...this.#firmware.code(bc, OPERATIONS).map((line) => this.#row(line, bc)));
    this.#named.replaceChildren(...this.#firmware.registers().map(({ names, value }) => pair(names, value)));
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
      const address = this.#firmware.address(input.value);
      input.setCustomValidity(address === undefined ? t("noPlace", input.value) : "");
      if (address === undefined) input.reportValidity();
      else use(address, input);
    });
    input.addEventListener("input", () => input.setCustomValidity(""));
    return form;
  }

  #row({ address, place, text }: Line, present: number): HTMLElement {
    const row = make("li", address === present ? "present" : "");
    const mark = button("stopHere", () => this.#toggle(address));
    mark.removeAttribute("data-t");
    mark.dataset["address"] = hex(address);
    mark.ariaPressed = String(this.#stops.has(address));
    mark.ariaLabel = t("stopHere", place || hex(address));
    mark.textContent = "●";
    row.append(mark, make("span", "number", hex(address)), make("b", "", place), make("span", "", text));
    return row;
  }

  /** Routines whose return addresses stand on the processor's stack; what stands there may be data, too. */
  #callers({ sp, memory }: Look): string[] {
    const top = this.#firmware.value("STKTOP") ?? sp;
    const places: string[] = [];
    for (let at = sp; at + 1 < top && places.length < CALLS; at += 2) {
      const word = (memory[at] ?? 0) | ((memory[at + 1] ?? 0) << 8);
      // (behind a CALL, or a restart)
      const isBehindCall = [0xcd, 0xc4, 0xcc, 0xd4, 0xdc, 0xe4, 0xec, 0xf4, 0xfc].includes(memory[word - 3] ?? 0);
      if (this.#firmware.file(word) && isBehindCall) places.push(this.#firmware.place(word));
    }
    return places;
  }

  #showMemory(): void {
    const from = this.#firmware.address(this.#address.value);
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
        bin.ariaLabel = t("deleteWork", this.#firmware.place(address));
        row.append(`${hex(address)} ${this.#firmware.place(address)} `, bin);
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
