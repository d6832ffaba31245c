/** The tape that is shown and its pictures: one at a time, the machine's, a file's, or that of the last visit. */
import type { Punched } from "./board.ts";
import { Chooser } from "./choice.ts";
import { Pictures } from "./pictures.ts";
import { type How, type KeptTape, type Maker, type Opened, Recording } from "./recording.ts";

export class Stage {
  readonly chooser = new Chooser();
  readonly recording = new Recording();
  readonly pictures = new Pictures(this.chooser, this.recording);

  /** Nothing, until `made` punches; what a run that is broken off still punches is left out. */
  clear(made: Maker, isLeaving: boolean): void {
    this.recording.leave(isLeaving);
    this.recording.clear(made);
    this.#begin();
  }

  /** Takes what the machine punches; `begun` is called for each tape that begins. */
  punched(punched: readonly Punched[], maker: () => Maker, begun: () => void): void {
    const again = this.recording.take(punched, maker, () => {
      this.#begin();
      begun();
    });
    this.pictures.grown(again);
  }

  /** Shows a tape from a file. */
  open(tape: Opened, made: Maker, how?: How, from?: number): void {
    this.recording.open(tape, made, how, from);
    this.pictures.isStale = false;
    this.#begin();
    this.pictures.grown(true);
  }

  /** Shows the tape of the last visit. */
  show(tape: KeptTape): void {
    this.recording.again(tape);
    this.#begin();
    this.pictures.grown(true);
  }

  /** The machine has told its program: it is that of the run that began last. */
  tell(made: Maker): void {
    if (this.recording.isFresh) this.recording.made = made;
    this.recording.isFresh = false;
  }

  /** It was made by another program than this one. */
  isOther(text: string): boolean {
    const { made, how } = this.recording;
    return made.program !== undefined && how !== "typed" && made.program !== text;
  }

  #begin(): void {
    this.chooser.choose(undefined);
    this.pictures.begin();
  }
}
