/** The tape's pictures: the drawing, the blocks, the punched tape, the controller's walk, and what is said of them. */
import { BlockList } from "./blocklist.ts";
import { partTitle } from "./catalogue.ts";
import type { Chooser } from "./choice.ts";
import { get } from "./dom.ts";
import { Drawing } from "./drawing.ts";
import type { Filmed } from "./film.ts";
import { t } from "./language.ts";
import { Plate } from "./plate.ts";
import { PunchedTape } from "./punched.ts";
import type { Maker, Recording } from "./recording.ts";
import { WalkBar } from "./walkbar.ts";
import { nameOf } from "./works.ts";

/** A machine's feed, mm a minute. */
const FEED = 5;

/** The name of a tape's maker: a part of the list, or a program by its title. */
const shownName = ({ name, program, isPart }: Maker): string => (isPart && partTitle(name)) || nameOf(program ?? "");

export class Pictures {
  readonly drawing: Drawing;
  readonly list: BlockList;
  readonly punched: PunchedTape;
  readonly plate = new Plate();
  /** Called when the wire sets out, and when it stands. */
  onPlay: ((isPlaying: boolean) => void) | undefined;
  readonly #chooser: Chooser;
  readonly #recording: Recording;
  #walkBar: WalkBar | undefined;
  /** The tape's program is not the one that is seen. */
  isStale = false;
  /** The controller has gone through all blocks that there are. */
  measured: Promise<void> | undefined;

  constructor(chooser: Chooser, recording: Recording) {
    this.#chooser = chooser;
    this.#recording = recording;
    this.drawing = new Drawing(get("base"), get("over"), chooser);
    this.list = new BlockList(get("list"), chooser);
    this.punched = new PunchedTape(get("punched"));
    this.list.describe = (line, stop) => [stop ? t("stopAfter") : "", line ? t("byLine", line) : ""].filter(Boolean).join(" · ");
  }

  startWalk(module: WebAssembly.Module): void {
    const parts = {
      play: get<HTMLButtonElement>("play"),
      scrub: get<HTMLInputElement>("scrub"),
      pace: get<HTMLSelectElement>("pace"),
      walked: get<HTMLOutputElement>("walked"),
      closing: get<HTMLOutputElement>("closing"),
    };
    this.#walkBar = new WalkBar(parts, this.drawing, module, (number, part) => {
      // (block and program line light up and come into sight)
      this.#chooser.choose({ block: number }, this.drawing);
      const { offsets, text } = this.#recording;
      const first = offsets[number - 1] ?? 0;
      this.punched.show(text, first + part * ((offsets[number] ?? text.length) - first));
    });
    this.#walkBar.onPlay = (isPlaying) => this.onPlay?.(isPlaying);
    if (!this.#recording.layout.blocks.length) return;
    this.#walkBar.begin(this.#recording.layout);
    this.measured = this.#walkBar.grown();
  }

  /** A contour does not close. */
  get gap(): boolean {
    return this.#walkBar?.gap ?? false;
  }

  /** The walk begins. */
  play(): void {
    this.#walkBar?.play();
  }

  /** Steel under the wire, or its plain path. */
  set isPlate(isPlate: boolean) {
    this.drawing.underlay = isPlate ? this.plate : undefined;
  }

  /** What may be filmed: the drawing, and the wire on its way. */
  get filmed(): Filmed {
    const { drawing, plate } = this;
    const recording = this.#recording;
    return {
      get layout() {
        return recording.layout;
      },
      picture: (onto) => drawing.picture(plate.steel.floor, onto),
      at: (part) => this.#walkBar?.at(part),
    };
  }

  /** Another tape, empty or whole. */
  begin(): void {
    const { layout } = this.#recording;
    this.drawing.show(layout);
    this.list.show(layout);
    this.#walkBar?.begin(layout);
    this.say();
  }

  /** There is more of it; `again`: what was there is not the same either. */
  grown(again: boolean): void {
    this.drawing.grown(again);
    this.list.grown(true);
    this.measured = this.#walkBar?.grown();
    this.say();
  }

  /** Writes what there is to say of it, in the present language. */
  say(): void {
    const { text, layout, isEmpty, isWhole, millimetres, made, how, from } = this.#recording;
    this.punched.show(text, text.length);
    get("no-blocks").hidden = !isEmpty;
    get("sum").textContent = isEmpty
      ? ""
      : `${t("summary", layout.blocks.length, millimetres.toFixed(1))}${isWhole ? "" : ` · ${t("partial")}`}`;
    get("time").textContent = isEmpty ? "" : t("time", Math.ceil(millimetres / FEED));
    const source = get("made");
    const maker = made.program === undefined ? t("fromFile", made.name) : shownName(made);
    const name = { run: maker, part: t("fromLine", maker, from), typed: t("typed"), mixed: t("mixed", maker) }[how];
    source.textContent = isEmpty ? "" : this.isStale ? t("stale", name) : name;
    source.classList.toggle("stale", (this.isStale || how !== "run") && !isEmpty);
  }

  retell(): void {
    this.#walkBar?.say();
    this.list.grown(false);
    this.say();
  }
}
