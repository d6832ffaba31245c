/** The menu Save and the links: files of the tape and the program, and everything as one. */
import { dxfText } from "./dxf.ts";
import { saveFile } from "./files.ts";
import { isoText } from "./iso.ts";
import { t } from "./language.ts";
import { MOST, pack } from "./link.ts";
import { ask, say } from "./message.ts";
import { isOneFile } from "./pieces.ts";
import type { Everything, Settings } from "./store.ts";
import { svgText } from "./svg.ts";
import type { Workbench } from "./workbench.ts";
import type { Work, Works } from "./works.ts";

export function everything({ session, stage: { recording } }: Workbench, settings: Settings, works: Work[]): Everything {
  const { text, how, from, made, kept } = recording;
  const lines = kept ? { lines: kept.lines } : {};
  const tape = { tape: text, made, ...lines, how, from };
  return { format: "skg-page", version: 1, kept: session.kept, settings: { ...settings }, ...tape, works };
}

/** Saves one kind of file. A tape that one RUN of the program that is seen has not made, from its first line to its end, is asked
 * for first. */
export async function save(kind: string, bench: Workbench, settings: Settings, works: Works): Promise<void> {
  const { editor, name } = bench;
  const { recording } = bench.stage;
  const { layout, made, isWhole, how, from } = recording;
  if (kind === "json") {
    saveFile(`${name}.json`, JSON.stringify(everything(bench, settings, works.all)));
    return;
  }
  if (kind === "skg") {
    if (editor.text) saveFile(`${name}.skg`, editor.text);
    else say("noProgram");
    return;
  }
  if (recording.isEmpty) {
    say("noBlocks");
    return;
  }
  const doubts = [
    ...(isWhole ? [] : [t("askPartial")]),
    ...(how === "part" ? [t("askPart", from)] : how === "run" ? [] : [t("askTyped")]),
    ...(bench.isStale ? [t("askStale")] : []),
  ];
  if (doubts.length && !(await ask(doubts.join(" "), t("saveAnyway")))) return;
  const by = how === "run" ? "" : how === "part" ? `-from-${from}` : "-typed";
  const stem = `${made.name}${by}${isWhole ? "" : "-unfinished"}`;
  const texts: Record<string, () => [string, string]> = {
    "3b": () => [".3b", recording.text],
    iso: () => [".nc", isoText(layout, isWhole)],
    svg: () => [".svg", svgText(layout, settings.wire, made.name)],
    dxf: () => [".dxf", dxfText(layout)],
  };
  const [ending, text] = (texts[kind] as () => [string, string])();
  saveFile(stem + ending, text);
}

/** Copies the address of a page that runs this program; that of a part of the list has a card with its picture. */
export async function copyLink(bench: Workbench): Promise<void> {
  const { part } = bench;
  // (a page in one file has no other pages beside it)
  const hasCard = part !== undefined && !isOneFile();
  const url = hasCard ? new URL(`part-${part}.html`, document.baseURI).href : await addressOf(bench.editor.text, "");
  if (url) await copy(url);
}

/** Copies what embeds this program in another page: text and drawing side by side, at the size of an article's picture. Its scripts
 * run, as those of an origin of their own; it can open the whole page, and nothing else. */
export async function copyEmbed(bench: Workbench): Promise<void> {
  const url = await addressOf(bench.editor.text, "&embed");
  const sandbox = "allow-scripts allow-same-origin allow-popups allow-popups-to-escape-sandbox";
  if (url) await copy(`<iframe src="${url}" title="SKG" width="100%" height="420" loading="lazy" sandbox="${sandbox}"></iframe>`);
}

async function addressOf(program: string, more: string): Promise<string | undefined> {
  const url = new URL(location.href);
  try {
    url.hash = `z=${await pack(program)}&run${more}`;
  } catch {
    say("badLarge", t("program"), MOST / 1024);
    return undefined;
  }
  return url.href;
}

async function copy(text: string): Promise<void> {
  try {
    await navigator.clipboard.writeText(text);
    say("copied");
  } catch {
    say("copyThis", text);
  }
}
