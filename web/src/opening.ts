/** Opens parts of the list, links, files. */
import { changeOf } from "./catalogue.ts";
import type { Course } from "./course.ts";
import { get } from "./dom.ts";
import { readWhole, recognize, tooLarge } from "./files.ts";
import { nameFor } from "./identity.ts";
import { t } from "./language.ts";
import { type Link, LinkError, readLink } from "./link.ts";
import { say, show } from "./message.ts";
import { markPart, type Part } from "./parts.ts";
import type { Everything, Settings } from "./store.ts";
import type { Workbench } from "./workbench.ts";
import type { Work, Works } from "./works.ts";

export class Opening {
  readonly #bench: Workbench;
  readonly #works: Works;
  readonly #course: Course;
  readonly #apply: (settings: Partial<Settings>) => void;
  parts: Part[] = [];

  /** `apply` puts settings in force. */
  constructor(bench: Workbench, works: Works, course: Course, apply: (settings: Partial<Settings>) => void) {
    this.#course = course;
    this.#bench = bench;
    this.#works = works;
    this.#apply = apply;
  }

  /** Opens a part, and shows it cut. */
  part(part: Part, run = true, isLinked = false): void {
    this.#course.close();
    void this.#bench.open(part.program, { run, isSound: true, isLinked });
    markPart(get("part-list"), part.name);
    this.tell(part);
  }

  /** Says in the program which number of a part may be changed. */
  tell({ name, program }: Part): void {
    const change = changeOf(name);
    if (!change || this.#bench.editor.text !== program) return;
    const { line, before, number } = change;
    const row = program.split("\n").find((each) => each.startsWith(`${line} `)) ?? "";
    this.#bench.editor.tip = { line, column: row.indexOf(before + number) + before.length, text: t("change", number) };
  }

  /** Follows the address' `#…`; `there`: the program that is in the machine, which stays when it is the link's, also where the
   * machine lists it in other letters (`link`: the one that it came from). What is wrong with the link is told; `isOpened`: it
   * has led to a program. */
  async link(hash: string, there?: string, link?: string): Promise<{ isOpened: boolean; fault?: () => void }> {
    if (hash.length < 2) return { isOpened: false };
    let read: Link;
    try {
      read = await readLink(hash);
    } catch (error) {
      if (!(error instanceof LinkError)) throw error;
      return { isOpened: false, fault: () => say("badLink") };
    }
    const { program, run, part: name = "", lesson, lessons } = read;
    if (lessons !== undefined) await this.#course.open(t("lessons"), lessons, lesson);
    else if (lesson !== undefined) await this.#course.begin(lesson);
    if (lesson !== undefined || lessons !== undefined) return { isOpened: true };
    this.#course.close();
    const part = this.parts.find((each) => each.name === name);
    const wanted = program ?? part?.program;
    if (wanted === undefined) return { isOpened: false, ...(name ? { fault: () => say("badPart", name) } : {}) };
    if (there !== undefined && (link === hash || there === wanted || there === part?.listed)) this.#bench.linked = there;
    else if (program !== undefined) await this.#open(program, { run, isLinked: true });
    else if (part) this.part(part, run, true);
    return { isOpened: true };
  }

  /** Opens a work of the visitor's. */
  work({ program }: Work): void {
    void this.#open(program, { run: true });
  }

  #open(text: string, how: { run?: boolean; file?: string; isLinked?: boolean }): Promise<void> {
    markPart(get("part-list"), undefined);
    this.#course.close();
    return this.#bench.open(text, how);
  }

  async file(file: File): Promise<void> {
    const found = tooLarge(file.name, file.size) ?? recognize(file.name, new Uint8Array(await file.arrayBuffer()));
    switch (found.kind) {
      case "program":
        await this.#open(found.text, { file: file.name });
        break;
      case "lessons":
        await this.#course.open(file.name, found.text);
        break;
      case "tape":
        await this.#tape(file.name, found.text);
        break;
      case "saved":
        await this.#saved(file.name, found.saved);
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
    stage.open(read, { name: name.replace(/\.\w+$/, ""), program: undefined });
    const said = t(read.isForeign ? "tapeForeign" : "tapeRead", name, stage.recording.layout.blocks.length);
    show(said + (read.isWhole ? "" : t("tapeNoEnd")));
  }

  /** A page that was saved: its machine, its text, its settings, its tape. With a tape that is none, all is left as it is. */
  async #saved(file: string, { kept, settings, tape, made, lines, how, from, works }: Everything): Promise<void> {
    const { editor, session, stage } = this.#bench;
    const read = tape ? await readWhole(file, tape) : undefined;
    if (read && "why" in read) {
      say(read.why, ...read.values);
      return;
    }
    this.#apply(settings);
    this.#works.add(works ?? []);
    if (kept) {
      this.#bench.keepText();
      this.#works.begin();
      session.bringBack(kept);
      if (kept.draft !== undefined) editor.text = kept.draft;
      this.#bench.origin = kept.about?.origin;
    }
    // (files of before have no name of their tape: it was called after the program)
    const { name } = nameFor(kept?.program ?? "", undefined, kept?.about?.origin);
    const isTape = lines?.map(({ text }) => `${text}\r\n`).join("") === tape;
    if (read && made && lines && isTape) stage.show({ made, lines, ...(how ? { how } : {}), ...(from ? { from } : {}) });
    else if (read) stage.open(read, made ?? { name, program: undefined }, how, from);
    else if (kept) stage.clear({ name, program: undefined }, false);
    say("imported", file);
  }
}
