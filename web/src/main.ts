/** The page: puts its parts together and starts the machine. */
import { bind } from "./controls.ts";
import { get, onClick } from "./dom.ts";
import { preferred, t, type Word } from "./language.ts";
import { closeManual, openManual, turnManual } from "./manual.ts";
import { say, show } from "./message.ts";
import { Opening } from "./opening.ts";
import { showParts } from "./parts.ts";
import { readImages, readPartList, readWalk, workerAddress } from "./pieces.ts";
import type { State } from "./runner.ts";
import { Session } from "./session.ts";
import { SettingsMenu, sound } from "./settings.ts";
import { view } from "./shell.ts";
import { type Everything, type Settings, Store } from "./store.ts";
import { Teletype } from "./teletype.ts";
import { isUpdated } from "./update.ts";
import { Workbench } from "./workbench.ts";
import { isAlike, showWorks, Works } from "./works.ts";

const WIRE = 0.18;
/** What a first visit shows. */
const FIRST = "wrench";
const STATES: Record<State, Word> = {
  busy: "busy",
  prompt: "prompt",
  input: "input",
  wait: "wait",
  tape: "waitTape",
  halt: "halt",
};

const isEmbedded = new URLSearchParams(location.hash.slice(1)).has("embed");
document.body.classList.toggle("embed", isEmbedded);
const store = new Store(() => say("noStore"));
const settings: Settings = {
  speed: "fast",
  language: preferred(navigator.languages),
  theme: "auto",
  wire: WIRE,
  auto: false,
  grid: false,
  ...sound(store.settings),
};

const works = new Works(
  isEmbedded ? { works: [] } : store,
  (program) => opening.parts.some((part) => isAlike(part.program, program)),
  tellWorks,
);
const bench = new Workbench({
  works,
  isAuto: () => settings.auto,
  openManual,
  showDrawing: () => view("drawing"),
});
const teletype = new Teletype(get("terminal"), { type: (text) => session.type(text), press: (key) => session.press(key) }, "");
let isSaid: Word | undefined;
const session = new Session(workerAddress(), teletype, isEmbedded ? undefined : store, {
  state: showState,
  punched: (punched) => bench.punched(punched),
  memory: (program) => {
    bench.memory(program, before);
    before = program;
  },
  error: (number, line) => bench.error(number, line),
  strange: (character) => say("notAscii", character),
  failed: (why) => {
    say("noMachine", why);
    for (const id of ["run", "reset", "send"]) get<HTMLButtonElement>(id).disabled = true;
  },
});
let before = "";
bench.session = session;
const menu = new SettingsMenu(settings, bench, teletype, (changed) => (store.settings = changed));
const opening = new Opening(bench, bringBack);
bind(bench, teletype, opening, settings);
onClick("close-manual", closeManual);
get("manual").addEventListener("click", (event) => {
  event.preventDefault();
  openManual();
});

/** Where something is asked, the keys go there. */
function showState(state: State): void {
  if (state === "prompt") bench.stage.recording.leave(false);
  if (state === "prompt" && !isEmbedded) store.tape = bench.stage.recording.kept;
  const word = STATES[state];
  get("run").textContent = t(session.isRunning ? "stop" : "run");
  if (word === isSaid) return;
  isSaid = word;
  get("state").textContent = session.isAlive ? t(word) : "";
  if (state === "input" && bench.isByHand) {
    view("teletype");
    teletype.focus();
  }
}

function tellWorks(): void {
  const box = get("work-list");
  showWorks(box, works, settings.language === "zh" ? "zh-CN" : "en-GB", (work) => void bench.open(work.name, work.program, true));
  get("works").hidden = !box.childElementCount;
}

function bringBack(saved: Everything): void {
  menu.apply(saved.settings);
  if (saved.kept) {
    works.keep(bench.editor.text);
    works.begin();
    session.bringBack(saved.kept);
    if (saved.kept.draft !== undefined) bench.editor.text = saved.kept.draft;
  }
  void opening.saved(saved.tape);
}

menu.onLanguage = () => {
  turnManual();
  isSaid = undefined;
  showState(session.state);
  if (opening.parts.length) tellParts();
  tellWorks();
};

function tellParts(): void {
  showParts(get("part-list"), opening.parts, (part) => {
    get("welcome").hidden = true;
    opening.part(part);
  });
}

/** Another tab has the machine that is kept. */
function lost(): void {
  works.begin();
  show(t("otherTab"), { label: t("keepHere"), take: () => store.ownAgain() });
}

async function begin(): Promise<void> {
  view("drawing");
  const last = isEmbedded ? null : store.machine;
  menu.apply({});
  if (!isEmbedded) {
    store.own(lost);
    store.watch(tellWorks);
  }
  const reading = readPartList().then(
    (found) => {
      opening.parts = found;
      tellParts();
    },
    () => say("noParts"),
  );
  if (!session.start(settings.speed, last, readImages())) say("badKept");
  if (last?.draft !== undefined) bench.editor.text = last.draft;
  const tape = last && store.tape;
  if (tape) {
    bench.name = tape.made.name;
    bench.stage.show(tape);
  }
  if (isEmbedded) {
    const full = get<HTMLAnchorElement>("full");
    full.hidden = false;
    full.href = location.href.replace(/&embed\b/, "");
  }
  const walking = readWalk().then(
    (module) => bench.stage.pictures.startWalk(module),
    (error: unknown) => say("noWalk", String(error)),
  );
  await Promise.all([reading, walking]);
  const isLinked = await opening.link(location.hash);
  addEventListener("hashchange", () => void opening.link(location.hash));
  const first = opening.parts.find(({ name }) => name === FIRST);
  if (!isLinked && !last && first) opening.part(first);
  get("welcome").hidden = Boolean(last) || isLinked || isEmbedded;
  document.body.dataset["ready"] = String(Math.round(performance.now()));
  if (!isEmbedded) await isUpdated();
}

void begin();
