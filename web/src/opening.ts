/** Opens parts of the list, links, files. */
import { get } from "./dom.ts";
import { readWhole, recognize, tooLarge } from "./files.ts";
import { t } from "./language.ts";
import { LinkError, readLink } from "./link.ts";
import { say, show } from "./message.ts";
import { markPart, type Part } from "./parts.ts";
import type { Everything, Settings } from "./store.ts";
import type { Workbench } from "./workbench.ts";
import type { Work, Works } from "./works.ts";

export class Opening {
  readonly #bench: Workbench;
  readonly #works: Works;
  readonly #apply: (settings: Partial<Settings>) => void;
  parts: Part[] = [];

  /** `apply` puts settings in force. */
  constructor(bench: Workbench, works: Works, apply: (settings: Partial<Settings>) => void) {
    this.#bench = bench;
    this.#works = works;
    this.#apply = apply;
  }

  /** Opens a part, and shows it cut. */
  part(part: Part, run = true): void {
    void this.#bench.open(part.program, { run, isSound: true });
    markPart(get("part-list"), part.name);
  }

  /** Follows the address' `#…`; false where there is none. */
  async link(hash: string): Promise<boolean> {
    if (hash.length < 2) return false;
    try {
      const link = await readLink(hash);
      const part = this.parts.find(({ name }) => name === link.part);
      // (what is changed from here on is the visitor's: a reload does not bring the link's program again)
      if (!link.embed) history.replaceState(null, "", location.pathname + location.search);
      if (link.program !== undefined) await this.#open(link.program, { run: link.run });
      else if (part) this.part(part, link.run);
      else if (link.part !== undefined) say("badPart", link.part);
      else return false;
    } catch (error) {
      if (!(error instanceof LinkError)) throw error;
      say("badLink");
    }
    return true;
  }

  /** Opens a work of the visitor's. */
  work({ program }: Work): void {
    void this.#open(program, { run: true });
  }

  #open(text: string, how: { run?: boolean; file?: string }): Promise<void> {
    markPart(get("part-list"), undefined);
    return this.#bench.open(text, how);
  }

  async file(file: File): Promise<void> {
    const found = tooLarge(file.name, file.size) ?? recognize(file.name, new Uint8Array(await file.arrayBuffer()));
    switch (found.kind) {
      case "program":
        await this.#open(found.text, { file: file.name });
        break;
      case "tape":
        await this.#tape(file.name, found.text);
        break;
      case "saved":
        await this.#saved(found.saved);
        say("imported", file.name);
        break;
      case "refused":
        say(found.why, ...found.values);
        break;
    }
  }

  /** Shows a tape from a file; it is read a little at a time, however long it is. */
  async #tape(name: string, text: string): Promise<void> {
    if (text.length > 100_000) say("reading", name);
    const read = await readWhole(name, text);
    if ("why" in read) {
      say(read.why, ...read.values);
      return;
    }
    const { stage } = this.#bench;
    stage.open(read, name.replace(/\.\w+$/, ""));
    const said = t(read.isForeign ? "tapeForeign" : "tapeRead", name, stage.recording.layout.blocks.length);
    show(said + (read.isWhole ? "" : t("tapeNoEnd")));
  }

  /** A page that was saved: its machine, its text, its settings, its tape. */
  async #saved({ kept, settings, tape, how, from, works }: Everything): Promise<void> {
    const { editor, session } = this.#bench;
    this.#apply(settings);
    this.#works.add(works ?? []);
    if (kept) {
      this.#bench.keepText();
      this.#works.begin();
      session.bringBack(kept);
      if (kept.draft !== undefined) editor.text = kept.draft;
      this.#bench.origin = kept.about?.origin;
    }
    const read = tape ? await readWhole("saved", tape) : undefined;
    if (!read || "why" in read) return;
    this.#bench.stage.open(read, this.#bench.name, how, from);
  }
}
