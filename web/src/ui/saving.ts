/** Saves files beside the drawing, or as downloads if the drawing was dropped on the page. The first time of a drawing it asks for
 * their name and the style of the tape. */
import { get } from "../dom.ts";
import { saveFile } from "../files.ts";
import { inPresent } from "../language.ts";
import { ask, show } from "../message.ts";
import type { Cutting } from "./cutting.ts";
import type { Desk } from "./desk.ts";
import { Gone, Refusal, type Server } from "./server.ts";
import type { FileKind, Member, Named, Style, Values } from "./types.ts";
import { w } from "./words.ts";

/** Endings of what is downloaded, behind the name without its own. */
const ENDINGS: Record<FileKind, string> = {
  tape: "",
  program: ".skg",
  sheet: "-sheet.pdf",
  job: ".job.toml",
  holes: "-holes.csv",
  drill: "-holes.nc",
};
/** The ending of a tape without drift, else of any. */
const TAPE = /\.nodrift\.3b$|\.3b$/;
/** A name that a control of eight letters takes. */
const EIGHT = /^[A-Z0-9_-]{1,8}$/i;
const BAD_NAME = /[\0-\x1f\x7f/\\:*?"<>|]|^\.|^$/;

export class Saving {
  readonly #desk: Desk;
  readonly #cutting: Cutting;
  readonly #server: Server;
  /** The drawing, and the job's form of the tape, for which name and style were asked. */
  #asked = "";
  #named: Named = { name: "", style: "punch", short: false };

  constructor(desk: Desk, cutting: Cutting, server: Server) {
    this.#desk = desk;
    this.#cutting = cutting;
    this.#server = server;
  }

  /** The drawing and the form of its tape that name and style are asked for: once for each. */
  get #subject(): string {
    return JSON.stringify([this.#desk.state?.name, this.#desk.edited.job.tape ?? {}]);
  }

  /** Name and style that were asked for, else those of the job. */
  get #wanted(): Named {
    if (this.#asked === this.#subject) return this.#named;
    const { style = "punch", short_name: short = false } = this.#desk.edited.job.tape ?? {};
    return { name: "", style: style as Style, short: short as boolean };
  }

  get style(): Style {
    return this.#wanted.style;
  }

  /** The form of the tape in the words of a job. */
  get form(): Values {
    const { style, short } = this.#wanted;
    return { style, short_name: short };
  }

  /** The drawing's name without its ending. */
  get #stem(): string {
    return (this.#desk.state?.name ?? "").replace(/\.\w+$/, "");
  }

  /** Saves the tape and what is ticked beside it; without a tape the job alone. `isNew`: asks for the name again. */
  async save(isNew = false): Promise<void> {
    const { state } = this.#desk;
    if (!state) return;
    const run = this.#cutting.isDone ? (this.#cutting.run ?? null) : null;
    if (run !== null && (isNew || this.#asked !== this.#subject) && !(await this.#ask())) return;
    const what: FileKind[] = run === null ? ["job"] : ticked();
    if (!what.length) return;
    try {
      await this.#desk.settle();
      const names = state.can_save ? await this.#written(run, what) : await this.#downloaded(run, what);
      if (names.length) show(w(state.can_save ? "saved" : "downloaded", names.join(", ")));
    } catch (error) {
      if (error instanceof Refusal) show(inPresent(error.fault.message));
      else if (error instanceof Gone) show(w("gone"));
      else throw error;
    }
  }

  /** Asks for name and style; false: nothing is saved. */
  async #ask(): Promise<boolean> {
    const dialog = get<HTMLDialogElement>("save-as");
    const [name, style] = [get<HTMLInputElement>("save-name"), get<HTMLSelectElement>("save-style")];
    const [eight, hint] = [get<HTMLInputElement>("save-eight"), get("save-hint")];
    const wanted = this.#wanted;
    style.value = wanted.style;
    eight.checked = wanted.short;
    name.value = wanted.name || (wanted.short ? shortened(this.#stem) : this.#stem);
    const check = (): boolean => {
      const isBad = BAD_NAME.test(name.value) || (eight.checked && !EIGHT.test(name.value));
      name.ariaInvalid = String(isBad);
      hint.textContent = isBad
        ? w(eight.checked ? "saveEightOnly" : "saveBadName")
        : eight.checked
          ? w("saveEightSays", name.value)
          : "";
      return !isBad;
    };
    name.oninput = check;
    eight.onchange = () => {
      if (eight.checked) name.value = shortened(name.value);
      check();
    };
    check();
    const isTaken = await new Promise<boolean>((tell) => {
      const end = (isYes: boolean): void => {
        if (isYes && !check()) {
          name.focus();
          return;
        }
        dialog.onclose = null;
        dialog.close();
        tell(isYes);
      };
      get("save-yes").onclick = () => end(true);
      get("save-no").onclick = () => end(false);
      dialog.onkeydown = (event) => {
        if (event.key !== "Enter" || event.target !== name) return;
        event.preventDefault();
        end(true);
      };
      dialog.onclose = () => tell(false);
      dialog.showModal();
      name.select();
    });
    if (!isTaken) return false;
    this.#asked = this.#subject;
    this.#named = { name: name.value, style: style.value as Style, short: eight.checked };
    return true;
  }

  async #downloaded(run: number | null, what: readonly FileKind[]): Promise<string[]> {
    const { outcome } = this.#cutting;
    const tape = outcome.kind === "done" ? outcome.result.tape_name : "";
    const stem = this.#named.name || this.#stem;
    const isPair = outcome.kind === "done" && outcome.result.mate !== undefined;
    const files: [string, Blob][] = [];
    if (what.includes("job")) {
      const job = run === null ? await this.#server.job() : await this.#server.jobOf(run, this.#named);
      files.push([this.#stem + ENDINGS.job, job]);
    }
    for (const member of (isPair ? ["punch", "die"] : ["punch"]) as Member[]) {
      const ending = isPair ? `-${this.#named.short ? member.charAt(0).toUpperCase() : member}` : "";
      for (const each of run === null ? [] : what.filter((kind) => kind !== "job")) {
        const isTape = each === "tape";
        const behind = isTape ? (!this.#named.short && TAPE.exec(tape)?.[0]) || ".3b" : ENDINGS[each];
        const file = isTape
          ? this.#server.tape(run as number, this.#named.style, member)
          : this.#server.file(run as number, each, member);
        files.push([stem + ending + behind, await file]);
      }
    }
    // (all or none)
    for (const [name, file] of files) saveFile(name, file);
    return files.map(([name]) => name);
  }

  /** Asks before it overwrites. */
  async #written(run: number | null, what: readonly FileKind[]): Promise<string[]> {
    const save = (isOver: boolean): Promise<string[]> => this.#server.save(run, what, isOver, this.#named);
    try {
      return await save(false);
    } catch (error) {
      if (!(error instanceof Refusal) || !error.exists.length) throw error;
      if (!(await ask(w("askOverwrite", error.exists.join(", ")), w("overwrite")))) return [];
      return save(true);
    }
  }
}

const ticked = (): FileKind[] =>
  [...get("save-as").querySelectorAll<HTMLInputElement>("[name=what]:checked")].map(({ value }) => value as FileKind);

const shortened = (name: string): string =>
  name
    .replace(/[^\w-]/g, "")
    .toUpperCase()
    .slice(0, 8);
