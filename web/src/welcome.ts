/** A first visit: a part is there, its wire cuts it, and a few lines say what this is. */

import { get } from "./dom.ts";
import type { Opening } from "./opening.ts";
import { isSmall } from "./shell.ts";
import type { Stage } from "./stage.ts";

const FIRST = "wrench";

export class Welcome {
  readonly #stage: Stage;
  #isWaiting = false;

  constructor(stage: Stage) {
    this.#stage = stage;
  }

  begin(opening: Opening): void {
    const first = opening.parts.find(({ name }) => name === FIRST);
    if (!first) return;
    // (on a small screen the drawing is seen first)
    if (isSmall()) get("walk").after(get("welcome"));
    get("welcome").hidden = false;
    this.#isWaiting = !matchMedia("(prefers-reduced-motion: reduce)").matches;
    opening.part(first);
  }

  /** The visitor looks at something else. */
  end(): void {
    this.#isWaiting = false;
    get("welcome").hidden = true;
  }

  /** The machine is at its prompt: the wire sets out when the tape is whole. */
  async isCut(): Promise<void> {
    const { recording, pictures } = this.#stage;
    if (!this.#isWaiting || !recording.isWhole) return;
    this.#isWaiting = false;
    await pictures.measured;
    if (!get("welcome").hidden) pictures.play();
  }
}
