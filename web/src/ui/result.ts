/** The result of the cut: its figures, the blocks, the program, the sheet, and the controller's walk over the drawing. */
import { BlockList } from "../blocklist.ts";
import { Chooser } from "../choice.ts";
import { get, make, onClick } from "../dom.ts";
import { saveFile } from "../files.ts";
import { inPresent } from "../language.ts";
import { show } from "../message.ts";
import { type Layout, layOut, nothing, type Placed } from "../placed.ts";
import { readTape } from "../tape.ts";
import { WalkBar } from "../walkbar.ts";
import type { Canvas } from "./canvas.ts";
import type { Cutting } from "./cutting.ts";
import { Drawer } from "./drawer.ts";
import { micrometres } from "./geometry.ts";
import { WayBack } from "./lying.ts";
import type { Saving } from "./saving.ts";
import { Gone, Refusal, type Server } from "./server.ts";
import type { TellTale } from "./told.ts";
import type { Member, Result, Run } from "./types.ts";
import { visible } from "./visible.ts";
import { type Word, w } from "./words.ts";

const STAGES: Record<Run["stage"], Word> = { plan: "stagePlan", board: "stageBoard", check: "stageCheck", write: "stageWrite" };

export class Results {
  readonly #cutting: Cutting;
  readonly #server: Server;
  readonly #canvas: Canvas;
  readonly #told: TellTale;
  readonly #saving: Saving;
  readonly #chooser = new Chooser();
  readonly #list: BlockList;
  readonly #walkBar: WalkBar;
  #layout: Layout = nothing();
  /** The run whose files are shown. */
  #shown: number | undefined;
  /** The run whose sheet is drawn, and its address. */
  #drawn: number | undefined;
  #sheet = "";
  /** The one of a pair that is shown. */
  #member: Member = "punch";

  constructor(cutting: Cutting, server: Server, canvas: Canvas, told: TellTale, saving: Saving, walk: WebAssembly.Module) {
    this.#cutting = cutting;
    this.#server = server;
    this.#canvas = canvas;
    this.#told = told;
    this.#saving = saving;
    this.#list = new BlockList(get("list"), this.#chooser);
    this.#list.describe = (_, stop) => (stop ? w("stopAfter") : "");
    const parts = {
      play: get<HTMLButtonElement>("play"),
      scrub: get<HTMLInputElement>("scrub"),
      pace: get<HTMLSelectElement>("pace"),
      walked: get<HTMLOutputElement>("walked"),
      // (the check has said that contours close: a tape with a tab ends elsewhere on purpose)
      closing: make("output", ""),
    };
    this.#walkBar = new WalkBar(parts, canvas, walk, (block) => this.#chooser.choose({ block }));
    // (a block that is chosen in the list is shown on the drawing)
    this.#chooser.onChange((choice) => {
      canvas.showBlock(this.#block(choice));
      this.#sayGoOn();
    });
    onClick("go-on-save", () => void this.#goOn());
    new Drawer(() => void this.#bringSheet());
    get("member").addEventListener("change", () => {
      void this.#choose(get<HTMLSelectElement>("member").value as Member);
    });
  }

  #block(choice = this.#chooser.choice): Placed | undefined {
    return choice && "block" in choice ? this.#layout.blocks[choice.block - 1] : undefined;
  }

  /** Says where the wire must stand for the rest of the tape, from the chosen block on. */
  #sayGoOn(): void {
    const block = this.#block();
    get("go-on").hidden = !block;
    const [first] = this.#layout.blocks;
    if (!block || !first) return;
    const [x, y] = block.start;
    const text = (micrometres: number): string => (micrometres / 1000).toFixed(3);
    get("go-on-text").textContent = w("goOn", block.number);
    get("go-on-place").textContent = w("goOnPlace", text(x), text(y));
    get("go-on-way").textContent = w("goOnWay", text(x - first.start[0]), text(y - first.start[1]));
    get("go-on-save").textContent = w("goOnSave", block.number);
  }

  /** Gives the rest of the tape as a file. */
  async #goOn(): Promise<void> {
    const [run, block, { outcome }] = [this.#shown, this.#block(), this.#cutting];
    if (run === undefined || !block || outcome.kind !== "done") return;
    try {
      const rest = await this.#server.tape(run, this.#saving.style, this.#member, block.number);
      const name = this.#of(outcome.result).tape_name.replace(/((\.nodrift)?\.3b)$/, `.from${block.number}$1`);
      saveFile(name, rest);
      this.#canvas.pointOnMachine(block.start);
      show(w("downloaded", name));
    } catch (error) {
      if (!(error instanceof Gone || error instanceof Refusal)) throw error;
      show(error instanceof Refusal ? inPresent(error.fault.message) : w("gone"));
    }
  }

  /** Shows how far the run is, or what came of it. */
  async show(): Promise<void> {
    this.say();
    const { outcome, run } = this.#cutting;
    if (outcome.kind !== "done") {
      if (this.#shown !== undefined) this.#clear();
    } else if (run !== undefined && run !== this.#shown) {
      this.#shown = run;
      if (!outcome.result.mate) this.#member = "punch";
      await Promise.all([this.#bring(run, outcome.result), this.#bringSheet()]);
    }
  }

  /** Shows the punch, or the die. */
  async #choose(member: Member): Promise<void> {
    this.#member = member;
    this.#shown = this.#drawn = undefined;
    await this.show();
  }

  /** The figures of the one that is shown. */
  #of(result: Result): Omit<Result, "lines" | "mate"> {
    return (this.#member === "die" && result.mate) || result;
  }

  #clear(): void {
    this.#shown = this.#drawn = undefined;
    this.#take(nothing());
    get("program").textContent = "";
    get("sheet").replaceChildren();
  }

  async #bring(run: number, result: Result): Promise<void> {
    try {
      const member = this.#member;
      const [tape, program] = await Promise.all([
        this.#server.file(run, "tape", member),
        this.#server.file(run, "program", member),
      ]);
      if (run !== this.#shown || member !== this.#member) return;
      const { start, back } = this.#of(result);
      this.#take(layOut(readTape(await tape.text()).items, micrometres(start)).layout, new WayBack(back));
      get("program").textContent = (await program.text()).replace(/\r\n/g, "\n");
    } catch (error) {
      if (!(error instanceof Gone || error instanceof Refusal)) throw error;
      this.#shown = undefined;
    }
  }

  /** The sheet is drawn when somebody looks at it: it takes a second or two. */
  async #bringSheet(): Promise<void> {
    const run = this.#shown;
    if (run === undefined || get("sheet").hidden || run === this.#drawn) return;
    this.#drawn = run;
    try {
      const sheet = await this.#server.file(run, "sheet.svg", this.#member);
      if (run !== this.#shown) return;
      URL.revokeObjectURL(this.#sheet);
      this.#sheet = URL.createObjectURL(sheet);
      const picture = make("img", "");
      picture.src = this.#sheet;
      picture.alt = w("sheet");
      const button = make("button", "main", w("print"));
      button.type = "button";
      button.addEventListener("click", () => print());
      get("sheet").replaceChildren(button, picture);
    } catch (error) {
      if (!(error instanceof Gone || error instanceof Refusal)) throw error;
      this.#drawn = undefined;
      get("sheet").textContent = error instanceof Refusal ? inPresent(error.fault.message) : w("gone");
    }
  }

  #take(layout: Layout, back?: WayBack): void {
    this.#layout = layout;
    this.#chooser.choose(undefined);
    this.#list.show(layout);
    this.#canvas.take(layout.blocks, back);
    get("walk").hidden = !layout.blocks.length;
    this.#walkBar.begin(layout);
    void this.#walkBar.grown();
  }

  /** Writes what there is to say, in the present language. */
  say(): void {
    const { outcome, isOld, isDone, isRunning } = this.#cutting;
    const output = get("outcome");
    output.className = "";
    const progress = get<HTMLProgressElement>("progress");
    progress.hidden = get("cancel").hidden = !isRunning;
    get("cut").hidden = isRunning;
    const save = get<HTMLButtonElement>("save");
    save.textContent = w(isDone ? "save" : "saveJob");
    save.classList.toggle("main", isDone);
    get("member").hidden = outcome.kind !== "done" || isOld || !outcome.result.mate;
    get<HTMLSelectElement>("member").value = this.#member;
    switch (outcome.kind) {
      case "none":
        output.textContent = "";
        break;
      case "running": {
        const { run } = outcome;
        if (run?.of) progress.value = run.done / run.of;
        else progress.removeAttribute("value");
        const stage = w(STAGES[run?.stage ?? "plan"]);
        output.textContent = run?.of ? w("progress", stage, run.done, run.of) : stage;
        break;
      }
      case "done":
        // (green: nothing wants a decision)
        output.className = isOld ? "old" : this.#told.open.length ? "care" : "good";
        output.textContent = isOld ? w("changedSince") : visible(inPresent(this.#of(outcome.result).figures));
        break;
      case "failed":
        output.className = isOld ? "old" : "bad";
        output.textContent = isOld ? w("changedSince") : w("failed");
        break;
      case "cancelled":
        output.textContent = w("cancelled");
        break;
    }
  }

  /** The language is another one. */
  name(): void {
    this.#walkBar.say();
    this.#list.grown(false);
    this.#sayGoOn();
    this.#drawn = undefined;
    void this.#bringSheet();
    this.say();
  }
}
