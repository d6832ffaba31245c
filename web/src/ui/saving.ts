/** Saves files beside the drawing, or as downloads if the drawing was dropped on the page. */
import { get } from "../dom.ts";
import { saveFile } from "../files.ts";
import { inPresent } from "../language.ts";
import { ask, show } from "../message.ts";
import type { Cutting } from "./cutting.ts";
import type { Desk } from "./desk.ts";
import { Gone, Refusal, type Server } from "./server.ts";
import type { FileKind } from "./types.ts";
import { w } from "./words.ts";

/** Endings of what is downloaded, behind the drawing's name without its own. */
const ENDINGS: Record<FileKind, string> = { tape: "", program: ".skg", sheet: "-sheet.pdf", job: ".job.toml" };

/** Saves the tape and what is ticked beside it; without a tape the job alone. */
export async function save(desk: Desk, cutting: Cutting, server: Server): Promise<void> {
  const ticked = [...get("save-what").querySelectorAll<HTMLInputElement>("input:checked")].map(({ value }) => value as FileKind);
  const what: FileKind[] = cutting.isDone ? ticked : ["job"];
  const run = cutting.isDone ? (cutting.run ?? null) : null;
  if (!desk.state || !what.length) return;
  try {
    await desk.settle();
    const names = desk.state.can_save ? await written(server, run, what) : await downloaded(desk, cutting, server, what);
    if (names.length) show(w(desk.state.can_save ? "saved" : "downloaded", names.join(", ")));
  } catch (error) {
    if (error instanceof Refusal) show(inPresent(error.fault.message));
    else if (error instanceof Gone) show(w("gone"));
    else throw error;
  }
}

async function downloaded(desk: Desk, { outcome, run }: Cutting, server: Server, what: readonly FileKind[]): Promise<string[]> {
  const tape = outcome.kind === "done" ? outcome.result.tape_name : "";
  const stem = (desk.state?.name ?? "").replace(/\.\w+$/, "");
  const names: string[] = [];
  for (const each of what) {
    const name = each === "tape" ? tape : stem + ENDINGS[each];
    saveFile(name, run === undefined ? await server.job() : await server.file(run, each));
    names.push(name);
  }
  return names;
}

/** Asks before it overwrites. */
async function written(server: Server, run: number | null, what: readonly FileKind[]): Promise<string[]> {
  try {
    return await server.save(run, what, false);
  } catch (error) {
    if (!(error instanceof Refusal) || !error.exists.length) throw error;
    if (!(await ask(w("askOverwrite", error.exists.join(", ")), w("overwrite")))) return [];
    return server.save(run, what, true);
  }
}
