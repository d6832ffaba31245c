/** The teletype: paper that scrolls back, and keys that type at the machine's pace. */
import { FitAddon } from "@xterm/addon-fit";
import { type ITheme, Terminal } from "@xterm/xterm";

/** Keys that arrive at once, whatever waits to be typed: ctrl-C, ctrl-S, ctrl-Q. */
const AT_ONCE = new Set([3, 17, 19]);
/** Characters of the paper that are kept for the next visit. */
const KEPT = 20_000;

export interface Keys {
  type(text: string): void;
  press(key: number): void;
}

export class Teletype {
  readonly #terminal: Terminal;
  readonly #fit = new FitAddon();
  #paper = "";

  constructor(box: HTMLElement, keys: Keys, name: string) {
    this.#terminal = new Terminal({
      convertEol: false,
      cursorBlink: false,
      fontSize: 14,
      scrollback: 5000,
      screenReaderMode: true,
      fontFamily: "ui-monospace, 'DejaVu Sans Mono', Menlo, Consolas, monospace",
      rows: 12,
      cols: 60,
    });
    this.#terminal.loadAddon(this.#fit);
    this.#terminal.open(box);
    this.name = name;
    this.#terminal.onData((text) => {
      const [only] = text.length === 1 ? [text.charCodeAt(0)] : [];
      if (only !== undefined && AT_ONCE.has(only)) keys.press(only);
      else keys.type(text.replace(/\x1b\[20[01]~/g, "").replace(/\x1b(?:\[[0-9;]*[A-Za-z~]|O[A-Z])/g, ""));
    });
    // Tab leaves the teletype: the keyboard alone must get everywhere, and a tab means nothing to the machine.
    // Ctrl-V pastes, and ctrl-C copies where something is marked.
    this.#terminal.attachCustomKeyEventHandler(
      (event) =>
        event.key !== "Tab" && !(event.ctrlKey && (event.key === "v" || (event.key === "c" && this.#terminal.hasSelection()))),
    );
    new ResizeObserver(() => this.fit()).observe(box);
    this.fit();
  }

  /** Its name for screen readers. */
  set name(name: string) {
    this.#terminal.textarea?.setAttribute("aria-label", name);
  }

  set theme(theme: ITheme) {
    this.#terminal.options.theme = theme;
  }

  /** The last lines printed, which are kept for the next visit. */
  get paper(): string {
    return this.#paper;
  }

  print(text: string, seen?: () => void): void {
    this.#paper = (this.#paper + text).slice(-KEPT);
    // (RUBOUT and bells are on a teletype's paper what they are on a screen: nothing)
    this.#terminal.write(text.replace(/\x7f/g, ""), seen);
  }

  clear(): void {
    this.#paper = "";
    this.#terminal.reset();
  }

  focus(): void {
    this.#terminal.focus();
  }

  fit(): void {
    const wanted = this.#fit.proposeDimensions();
    if (wanted && wanted.cols > 5 && wanted.rows > 1) this.#terminal.resize(wanted.cols, wanted.rows);
  }
}
