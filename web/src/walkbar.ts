/** The bar below the drawing: the controller's walk to play, stop and scrub. */

import { tell } from "./dom.ts";
import type { Drawing } from "./drawing.ts";
import { t } from "./language.ts";
import { type Layout, nothing } from "./placed.ts";
import type { XY } from "./tape.ts";
import { Stalled, Walk } from "./walk.ts";

/** A machine's feed, mm a minute; the walk's speed is a multiple of it. */
const FEED = 5;
/** So long may the walk through all blocks hold the page up at a time, ms. */
const PATIENCE = 6;

/** A gap of so many µm comes of rounding. */
const ROUNDED = 5;

interface Parts {
  play: HTMLButtonElement;
  scrub: HTMLInputElement;
  pace: HTMLSelectElement;
  walked: HTMLOutputElement;
  closing: HTMLOutputElement;
}

export class WalkBar {
  readonly #parts: Parts;
  readonly #drawing: Pick<Drawing, "walk">;
  readonly #walk: Walk;
  readonly #moved: (block: number, part: number) => void;
  #layout: Layout = nothing();
  #step = 0;
  #isPlaying = false;
  #isShown = false;
  #last = 0;
  #generation = 0;
  #problem = "";
  /** Called when the wire sets out, and when it stands. */
  onPlay: ((isPlaying: boolean) => void) | undefined;

  /** `moved` is called with the number of the block under way and how much of it is done. */
  constructor(
    parts: Parts,
    drawing: Pick<Drawing, "walk">,
    module: WebAssembly.Module,
    moved: (block: number, part: number) => void,
  ) {
    this.#parts = parts;
    this.#drawing = drawing;
    this.#walk = new Walk(module);
    this.#moved = moved;
    parts.play.addEventListener("click", () => this.#toggle());
    parts.scrub.addEventListener("input", () => {
      this.#stop();
      this.#step = Number(parts.scrub.value);
      this.#isShown = true;
      this.#show();
    });
    this.say();
  }

  /** Another tape, whole or as far as it is punched. */
  begin(layout: Layout): void {
    this.#layout = layout;
    this.#stop();
    this.#step = 0;
    this.#isShown = false;
    this.#problem = "";
    this.#walk.begin(layout.blocks);
    this.#parts.scrub.max = "0";
    this.#parts.scrub.value = "0";
    this.#drawing.walk = undefined;
    this.say();
  }

  /** There are more blocks: the controller goes through them, a little at a time. */
  async grown(): Promise<void> {
    const generation = ++this.#generation;
    for (;;) {
      const end = performance.now() + PATIENCE;
      let done = false;
      try {
        while (!done && performance.now() < end) done = this.#walk.measure(200_000);
      } catch (error) {
        if (!(error instanceof Stalled)) throw error;
        this.#problem = t("stalled", error.block);
        done = true;
      }
      this.#parts.scrub.max = String(this.#walk.steps);
      this.say(!done);
      if (done) return;
      await new Promise((resume) => setTimeout(resume));
      if (generation !== this.#generation) return;
    }
  }

  /** Writes what it has to say, in the present language. */
  say(isMeasuring = false): void {
    const { play, scrub, closing } = this.#parts;
    play.textContent = t(this.#isPlaying ? "pause" : "play");
    play.disabled = scrub.disabled = !this.#layout.blocks.length;
    const gap = this.#walk.closing(this.#layout.routes);
    tell(closing, this.#problem || (isMeasuring ? t("measuring") : !gap ? "" : closingWords(gap)));
    this.#show();
  }

  #toggle(): void {
    if (this.#isPlaying) this.#stop();
    else this.play();
  }

  play(): void {
    if (this.#step >= this.#walk.steps) this.#step = 0;
    this.#isPlaying = this.#isShown = true;
    this.onPlay?.(true);
    this.#parts.play.textContent = t("pause");
    this.#last = performance.now();
    requestAnimationFrame((now) => this.#frame(now));
  }

  /** A contour does not close, by more than comes of rounding. */
  get gap(): boolean {
    const gap = this.#walk.closing(this.#layout.routes);
    return gap !== undefined && Math.max(...gap.map(Math.abs)) > ROUNDED;
  }

  /** Puts the wire at a part of its way, 0 to 1; it stands. */
  at(part: number): void {
    if (this.#isPlaying) this.#stop();
    this.#step = part * this.#walk.steps;
    this.#isShown = true;
    this.#parts.scrub.value = String(Math.floor(this.#step));
    this.#show();
  }

  #stop(): void {
    this.#isPlaying = false;
    this.onPlay?.(false);
    this.#parts.play.textContent = t("play");
  }

  #frame(now: number): void {
    if (!this.#isPlaying) return;
    const { walked } = this.#walk;
    const at = this.#walk.locate(this.#step)?.at ?? 0;
    // A block's steps along its length: the feed is in mm, and a diagonal has more steps.
    const steps = walked[at]?.steps ?? 1;
    const length = Math.max(1, this.#layout.blocks[at]?.length ?? 1);
    const perSecond = ((FEED * 1000) / 60) * Number(this.#parts.pace.value) * (steps / length);
    this.#step = Math.min(this.#walk.steps, this.#step + (perSecond * Math.max(0, Math.min(100, now - this.#last))) / 1000);
    this.#last = now;
    this.#parts.scrub.value = String(Math.floor(this.#step));
    this.#show();
    if (this.#step >= this.#walk.steps) this.#stop();
    else requestAnimationFrame((next) => this.#frame(next));
  }

  #show(): void {
    const position = this.#isShown ? this.#walk.locate(this.#step) : undefined;
    if (!position) {
      this.#parts.walked.textContent = "";
      return;
    }
    const steps = this.#walk.walked[position.at]?.steps ?? 1;
    const part = steps ? position.step / steps : 1;
    const [x, y] = position.place;
    const text = t(
      "walkAt",
      position.at + 1,
      this.#layout.blocks.length,
      (x / 1000).toFixed(3),
      (y / 1000).toFixed(3),
      position.off.toFixed(2),
    );
    this.#parts.walked.textContent = text;
    this.#parts.scrub.ariaValueText = text;
    this.#drawing.walk = { place: position.place, at: position.at, done: part };
    this.#moved(position.at + 1, part);
  }
}

/** Words for a contour's gap. Arcs' ends are rounded, so a gap of a few µm is normal. */
function closingWords(gap: XY): string {
  const most = Math.max(...gap.map(Math.abs));
  return !most ? t("closes") : most <= ROUNDED ? t("near", most) : t("gap", ...gap);
}
