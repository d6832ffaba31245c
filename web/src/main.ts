/** The page: the machine, its teletype, the drawing, and what belongs together between them. */
import type { Punched } from "./board.ts";
import { BlockList } from "./blocklist.ts";
import { Chooser } from "./choice.ts";
import { Drawing } from "./drawing.ts";
import { dxfText } from "./dxf.ts";
import { recognize, saveFile, tooLarge } from "./files.ts";
import { isoText } from "./iso.ts";
import { isWord, preferred, speak, t, type Language, type Word } from "./language.ts";
import { LinkError, pack, readLink } from "./link.ts";
import { Machine } from "./machine.ts";
import { markPart, readParts, showParts, type Part } from "./parts.ts";
import { layOut, Placer, type Layout } from "./placed.ts";
import { ProgramView } from "./program.ts";
import { PunchedTape } from "./punched.ts";
import { fromBase64, Store, toBase64, type Everything, type Settings, type Theme } from "./store.ts";
import { svgText } from "./svg.ts";
import { itemText, readBlock, tapeText, type Item } from "./tape.ts";
import { Teletype } from "./teletype.ts";
import { WalkBar } from "./walkbar.ts";
import type { Speed, State } from "./worker.ts";

const CTRL_C = 3;
const WIRE = 0.18;

function get<T extends HTMLElement>(id: string): T {
  const found = document.getElementById(id);
  if (!found) throw new Error(`no #${id}`);
  return found as T;
}

// What is kept, and the settings -----------------------------------------------------------------------------

const isEmbedded = new URLSearchParams(location.hash.slice(1)).has("embed");
document.body.classList.toggle("embed", isEmbedded);
const store = new Store(() => say("noStore"));
const settings: Settings = {
  speed: "fast", language: preferred(navigator.languages), theme: "auto", wire: WIRE, ...store.settings,
};

/** One sentence on top of the page, until it is put away; `undo` offers to put back what was in the machine. */
function say(word: Word, ...values: (string | number)[]): void {
  show(t(word, ...values));
}

function show(text: string, undo?: () => void): void {
  const box = get("message");
  box.hidden = false;
  (box.firstElementChild as HTMLElement).textContent = text;
  const button = get<HTMLButtonElement>("undo");
  button.hidden = !undo;
  button.onclick = () => {
    box.hidden = true;
    undo?.();
  };
}

get("dismiss").addEventListener("click", () => (get("message").hidden = true));

// The tape and its pictures ----------------------------------------------------------------------------------

const chooser = new Chooser();
const drawing = new Drawing(get("base"), get("over"), chooser);
const list = new BlockList(get("list"), chooser);
const punchedTape = new PunchedTape(get("punched"));
let walkBar: WalkBar | undefined;
let placer = new Placer();
let items: Item[] = [];
/** The tape as it was punched, and where in it each block begins. */
let tape = "";
let offsets: number[] = [];
let isWhole = false;
let partName = "part";
/** A run is broken off for another program: what it still punches is not that program's. */
let isLeaving = false;
const program = new ProgramView(get("lines"), chooser, () => placer.layout);

const layout = (): Layout => placer.layout;

function newTape(): void {
  placer = new Placer();
  items = [];
  tape = "";
  offsets = [];
  isWhole = false;
  chooser.choose(undefined);
  drawing.show(layout());
  list.show(layout());
  walkBar?.begin(layout());
  showTape();
}

/** Lines from the punch: blocks, stops, the end; RUN: another tape begins. */
function take(punched: readonly Punched[]): void {
  let again = false;
  for (const { text, line, x, y } of punched) {
    if (isLeaving && text !== "RUN") continue;
    if (text === "RUN") {
      isLeaving = false;
      if (items.length || isWhole) newTape();
      again = false;
      continue;
    }
    if (isWhole) newTape(); // (direct statements after a tape's end)
    const block = readBlock(text);
    if (block) offsets.push(tape.length);
    tape += `${text}\r\n`;
    if (text === "DD") {
      placer.end();
      isWhole = again = true;
    } else if (block || text === "D") {
      items.push(block ?? "D");
      placer.add(block ?? "D", line, [x, y]);
      again ||= !block;
    }
  }
  grown(again);
}

function grown(again: boolean): void {
  drawing.grown(again);
  list.grown(true);
  void walkBar?.grown();
  showTape();
}

function showTape(): void {
  punchedTape.show(tape, tape.length);
  get("no-blocks").hidden = items.length > 0;
  const length = layout().blocks.reduce((sum, placed) => sum + placed.length, 0) / 1000;
  get("sum").textContent = items.length ? `${t("summary", layout().blocks.length, length.toFixed(1))}` +
    (isWhole ? "" : ` · ${t("partial")}`) : "";
}

/** Shows a tape that comes from a file. */
function openTape(found: readonly Item[]): void {
  newTape();
  placer = layOut(found);
  for (const item of found) {
    if (item !== "D") offsets.push(tape.length);
    tape += `${itemText(item)}\r\n`;
  }
  tape += "DD\r\n";
  items = [...found];
  isWhole = true;
  drawing.show(layout());
  walkBar?.begin(layout());
  list.show(layout());
  grown(true);
  view("drawing");
}

function startWalk(module: WebAssembly.Module): void {
  walkBar = new WalkBar({
    play: get("play"), scrub: get("scrub"), pace: get("pace"), walked: get("walked"), closing: get("closing"),
  }, drawing, module, (number, part) => {
    const first = offsets[number - 1] ?? 0;
    punchedTape.show(tape, first + part * ((offsets[number] ?? tape.length) - first));
  });
  if (layout().blocks.length) {
    walkBar.begin(layout());
    void walkBar.grown();
  }
}

// The machine ------------------------------------------------------------------------------------------------

let present: State = "busy";
let isAlive = true;
let kept: { ram: string; rom: string } | undefined;
let tail = "";
/** What was in the machine before something was loaded over it. */
let before: string | undefined;

const teletype = new Teletype(get("terminal"), {
  type: (text) => machine.type(text),
  press: (key) => machine.press(key),
}, "");

const machine = new Machine({
  out(paper, punched, seen) {
    teletype.print(paper, seen);
    if (punched.length) take(punched);
    lookForError(paper);
  },
  state(state) {
    present = state;
    if (state === "prompt") isLeaving = false;
    showState();
  },
  memory(ram, text, rom) {
    program.text = text;
    kept = { ram: toBase64(ram), rom };
    keep();
  },
  failed(why) {
    isAlive = false;
    say("noMachine", why);
    for (const id of ["run", "reset", "send"]) get<HTMLButtonElement>(id).disabled = true;
  },
});

function keep(): void {
  if (kept && !isEmbedded) store.machine = { ...kept, program: program.text, paper: teletype.paper };
}
addEventListener("pagehide", keep);
document.addEventListener("visibilitychange", () => {
  if (document.visibilityState === "hidden") keep();
});

const STATES: Record<State, Word> = {
  busy: "busy", prompt: "prompt", input: "input", wait: "wait", tape: "waitTape", halt: "halt",
};

/** Ctrl-C gets it back to its prompt. */
const isRunning = (): boolean => present !== "prompt" && present !== "halt";

let isSaid: Word | undefined;
function showState(): void {
  const word = STATES[present];
  get("run").textContent = t(isRunning() ? "stop" : "run");
  if (word === isSaid) return;
  isSaid = word;
  get("state").textContent = isAlive ? t(word) : "";
}

/** An ERR on the paper is said in words, and its line is marked. */
function lookForError(paper: string): void {
  tail = (tail + paper).slice(-400);
  const found = [...tail.matchAll(/(?:^|\n)ERR (\d\d)(?: LINE (\d+))?\r\n/g)].at(-1);
  if (/RUN\r\n|LOAD\r\n/.test(tail)) program.wrong = 0;
  if (!found) return;
  const [, number = "", line] = found;
  tail = tail.slice((found.index ?? 0) + found[0].length);
  const word = `err${number}`;
  if (!isWord(word)) return;
  if (line) program.wrong = Number(line);
  say(line ? "endedLine" : "ended", number, t(word), line ?? "");
}

/** Puts a program into the machine, in place of what is there; that can be put back. */
function loadProgram(name: string, text: string, run: boolean): void {
  if (!isAlive) return;
  const there = program.text;
  const isKnown = parts.some((part) => sameProgram(part.program, there));
  program.wrong = 0;
  partName = name.replace(/\.\w+$/, "") || "part";
  get("message").hidden = true;
  isLeaving = present !== "prompt";
  newTape();
  if (there && !isKnown && !sameProgram(text, there)) {
    before = there;
    show(t("loaded", name), () => {
      if (before !== undefined) machine.load(before, false);
    });
  }
  machine.load(text, run);
}

const sameProgram = (a: string, b: string): boolean => a.replace(/\s/g, "") === b.replace(/\s/g, "");

// Parts, links, files ----------------------------------------------------------------------------------------

let parts: Part[] = [];

function openPart(part: Part, run: boolean): void {
  markPart(get("part-list"), part.name);
  loadProgram(part.name, part.program, run);
}

async function followLink(): Promise<void> {
  const hash = location.hash;
  if (hash.length < 2) return;
  try {
    const link = await readLink(hash);
    const part = parts.find(({ name }) => name === link.part);
    if (link.program !== undefined) loadProgram("link", link.program, link.run);
    else if (part) openPart(part, link.run);
    else if (link.part !== undefined) say("badPart", link.part);
  } catch (error) {
    if (!(error instanceof LinkError)) throw error;
    say("badLink");
  }
}
addEventListener("hashchange", () => void followLink());

async function openFile(file: File): Promise<void> {
  const found = tooLarge(file.name, file.size) ?? recognize(file.name, new Uint8Array(await file.arrayBuffer()));
  switch (found.kind) {
    case "program":
      markPart(get("part-list"), undefined);
      loadProgram(file.name, found.text, false);
      break;
    case "tape": {
      partName = file.name.replace(/\.\w+$/, "");
      openTape(found.tape.items);
      const blocks = found.tape.items.filter((item) => item !== "D").length;
      show(t(found.tape.isForeign ? "tapeForeign" : "tapeRead", file.name, blocks) +
        (found.tape.hasNoEnd ? t("tapeNoEnd") : ""));
      break;
    }
    case "saved":
      bringBack(found.saved);
      say("imported", file.name);
      break;
    case "refused":
      say(found.why, ...found.values);
      break;
  }
}

function everything(): Everything {
  return {
    format: "skg-page", version: 1,
    kept: kept ? { ...kept, program: program.text, paper: teletype.paper } : null, settings: { ...settings }, tape,
  };
}

function bringBack(saved: Everything): void {
  applySettings(saved.settings);
  if (saved.kept) {
    const ram = fromBase64(saved.kept.ram);
    teletype.clear();
    teletype.print(saved.kept.paper);
    if (ram) machine.restore(ram, saved.kept.program, saved.kept.rom);
    else machine.load(saved.kept.program, false);
  }
  const found = saved.tape ? recognize("saved.3b", new TextEncoder().encode(saved.tape)) : undefined;
  if (found?.kind === "tape") openTape(found.tape.items);
}

const SAVERS: Record<string, () => [string, string]> = {
  skg: () => [".skg", program.text],
  "3b": () => [".3b", isWhole ? tape : tapeText(items)],
  iso: () => [".nc", isoText(layout())],
  svg: () => [".svg", svgText(layout(), settings.wire, partName)],
  dxf: () => [".dxf", dxfText(layout())],
  json: () => [".json", JSON.stringify(everything())],
};

async function address(embed: boolean): Promise<string> {
  const url = new URL(location.href);
  url.hash = `z=${await pack(program.text)}&run${embed ? "&embed" : ""}`;
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

// The page's controls ----------------------------------------------------------------------------------------

function on(id: string, action: () => void): void {
  get(id).addEventListener("click", action);
}

on("run", () => {
  if (isRunning()) machine.press(CTRL_C);
  else machine.type("RUN\r");
});
on("reset", () => machine.reset());
on("tear", () => teletype.clear());
on("fit", () => drawing.fit());
on("closer", () => drawing.zoom(1.5));
on("farther", () => drawing.zoom(1 / 1.5));
on("copy-link", () => void address(false).then(copy));
on("copy-embed", () => void address(true).then((url) =>
  copy(`<iframe src="${url}" title="SKG" width="800" height="500"></iframe>`)));

for (const button of document.querySelectorAll<HTMLElement>("[data-key]")) {
  // (who types goes on typing: the teletype keeps the focus, and a phone its keyboard)
  button.addEventListener("mousedown", (event) => event.preventDefault());
  button.addEventListener("click", () => {
    const key = Number(button.dataset["key"]);
    if (key === 13 || key === 127) machine.type(String.fromCharCode(key));
    else machine.press(key);
  });
}
for (const button of document.querySelectorAll<HTMLElement>("[data-save]")) {
  button.addEventListener("click", () => {
    const [ending, text] = (SAVERS[button.dataset["save"] ?? ""] as () => [string, string])();
    if (text) saveFile(partName + ending, text);
    else say(ending === ".skg" ? "noProgram" : "noBlocks");
  });
}

const picker = get<HTMLInputElement>("file");
let picked = (file: File): void => void openFile(file);
function pick(use: (file: File) => void): void {
  picked = use;
  picker.value = "";
  picker.click();
}
picker.addEventListener("change", () => {
  const [file] = picker.files ?? [];
  if (file) picked(file);
});
on("open", () => pick((file) => void openFile(file)));
on("send", () => pick((file) => void file.text().then((text) => {
  const large = tooLarge(file.name, file.size);
  if (large?.kind === "refused") say(large.why, ...large.values);
  else machine.type(text);
})));
addEventListener("dragover", (event) => event.preventDefault());
addEventListener("drop", (event: DragEvent) => {
  event.preventDefault();
  const [file] = event.dataTransfer?.files ?? [];
  if (file) void openFile(file);
});

// A menu closes when something else is pressed, and by Escape.
for (const menu of document.querySelectorAll<HTMLDetailsElement>("details.menu")) {
  menu.addEventListener("keydown", (event) => {
    if (event.key !== "Escape") return;
    menu.open = false;
    menu.querySelector("summary")?.focus();
  });
  menu.addEventListener("click", (event) => {
    if ((event.target as HTMLElement).closest("button")) menu.open = false;
  });
}
addEventListener("pointerdown", (event) => {
  for (const menu of document.querySelectorAll<HTMLDetailsElement>("details.menu[open]")) {
    if (!menu.contains(event.target as Node)) menu.open = false;
  }
});

// Editing
const editor = get<HTMLTextAreaElement>("editor");
function edit(isOn: boolean): void {
  editor.hidden = get("load").hidden = get("cancel").hidden = !isOn;
  get("edit").hidden = isOn;
  get("lines").hidden = isOn;
  if (isOn) {
    editor.value = program.text;
    editor.focus();
  } else {
    get("edit").focus();
  }
}
on("edit", () => edit(true));
on("cancel", () => edit(false));
on("load", () => {
  const found = recognize(`${t("editor")}.skg`, new TextEncoder().encode(editor.value));
  if (found.kind === "refused") {
    say(found.why, ...found.values);
    return;
  }
  edit(false);
  machine.load(editor.value, false);
});

// On a small screen one section is seen at a time.
function view(name: string): void {
  document.body.dataset["view"] = name;
  for (const button of document.querySelectorAll<HTMLElement>("#views [data-view]")) {
    button.ariaCurrent = button.dataset["view"] === name ? "true" : null;
  }
  teletype.fit();
}
for (const button of document.querySelectorAll<HTMLElement>("#views [data-view]")) {
  button.addEventListener("click", () => view(button.dataset["view"] ?? ""));
}
document.querySelector(".skip")?.addEventListener("click", (event) => {
  event.preventDefault();
  view("teletype");
  teletype.focus();
});

drawing.onPoint = (place) => {
  get("place").textContent = place ? t("where", (place[0] / 1000).toFixed(3), (place[1] / 1000).toFixed(3)) : "";
};
list.describe = (line, stop) => [stop ? t("stopAfter") : "", line ? t("byLine", line) : ""].filter(Boolean).join(" · ");

// Settings
const isDarkSystem = matchMedia("(prefers-color-scheme: dark)");
function applySettings(changed: Partial<Settings>): void {
  if (changed.speed === "fast" || changed.speed === "real") settings.speed = changed.speed;
  if (changed.language === "en" || changed.language === "zh") settings.language = changed.language;
  if (changed.theme === "auto" || changed.theme === "light" || changed.theme === "dark") settings.theme = changed.theme;
  if (typeof changed.wire === "number" && changed.wire >= 0 && changed.wire <= 5) settings.wire = changed.wire;
  get<HTMLSelectElement>("speed").value = settings.speed;
  get<HTMLSelectElement>("language").value = settings.language;
  get<HTMLSelectElement>("theme").value = settings.theme;
  get<HTMLInputElement>("wire").value = String(settings.wire);
  machine.speed(settings.speed);
  drawing.wireWidth = settings.wire;
  speak(settings.language as Language, document);
  teletype.name = t("teletype");
  isSaid = undefined;
  showState();
  walkBar?.say();
  list.grown(false);
  showTape();
  paint();
}

function paint(): void {
  const dark = settings.theme === "dark" || (settings.theme === "auto" && isDarkSystem.matches);
  document.documentElement.dataset["theme"] = dark ? "dark" : "light";
  const style = getComputedStyle(document.documentElement);
  const colour = (name: string): string => style.getPropertyValue(`--${name}`).trim();
  drawing.colours = {
    wire: colour("wire"), lead: colour("lead"), chosen: colour("mark"), walk: colour("walk"), ruler: colour("dim"),
  };
  teletype.theme = {
    background: colour("panel"), foreground: colour("text"), cursor: colour("strong"), cursorAccent: colour("panel"),
    selectionBackground: colour("chosen"), selectionForeground: colour("chosen-text"),
  };
  punchedTape.colours = { paper: colour("tape"), hole: colour("hole"), mark: colour("walk") };
  punchedTape.show(tape, tape.length);
}
isDarkSystem.addEventListener("change", paint);

function change(changed: Partial<Settings>): void {
  applySettings(changed);
  store.settings = changed;
}
get("speed").addEventListener("change", () => change({ speed: get<HTMLSelectElement>("speed").value as Speed }));
get("language").addEventListener("change", () => change({ language: get<HTMLSelectElement>("language").value }));
get("theme").addEventListener("change", () => change({ theme: get<HTMLSelectElement>("theme").value as Theme }));
get("wire").addEventListener("change", () => change({ wire: get<HTMLInputElement>("wire").valueAsNumber || 0 }));

// The start --------------------------------------------------------------------------------------------------

async function begin(): Promise<void> {
  view("drawing");
  const last = isEmbedded ? null : store.machine;
  const ram = last ? fromBase64(last.ram) : undefined;
  applySettings({});
  if (last) {
    teletype.print(last.paper);
    if (!ram) say("badKept");
  }
  machine.start(settings.speed, last ? { ram, program: last.program, rom: last.rom } : undefined);
  if (isEmbedded) {
    const full = get<HTMLAnchorElement>("full");
    full.hidden = false;
    full.href = location.href.replace(/&embed\b/, "");
  }
  const reading = readParts().then((found) => {
    parts = found;
    showParts(get("part-list"), parts, (part) => openPart(part, false));
  }, () => say("noParts"));
  const walking = fetch("walk.wasm").then((answer) => answer.arrayBuffer()).then((code) => WebAssembly.compile(code))
    .then(startWalk).catch((error: unknown) => say("noWalk", String(error)));
  await Promise.all([reading, walking]);
  await followLink();
  document.body.dataset["ready"] = String(Math.round(performance.now()));
  if ("serviceWorker" in navigator && !isEmbedded) {
    await navigator.serviceWorker.register("offline.js").catch(() => undefined);
  }
}

void begin();
