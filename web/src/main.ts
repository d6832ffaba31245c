/** The page: puts its parts together and starts the machine. */
import { bind } from "./controls.ts";
import { Course } from "./course.ts";
import { get, onClick } from "./dom.ts";
import { Inside } from "./inside.ts";
import { keepSafe } from "./keeping.ts";
import { preferred, t } from "./language.ts";
import { openManual, openReading, turnManual } from "./manual.ts";
import { say, warn } from "./message.ts";
import { Opening } from "./opening.ts";
import { closePane } from "./pane.ts";
import { showParts } from "./parts.ts";
import { readImages, readModule, readPartList, workerAddress } from "./pieces.ts";
import { rove } from "./roving.ts";
import { Session } from "./session.ts";
import { SettingsMenu, sound } from "./settings.ts";
import { isSmall, view } from "./shell.ts";
import { Sound } from "./sound.ts";
import { StatusLine } from "./statusline.ts";
import { type Settings, Store } from "./store.ts";
import { Teletype } from "./teletype.ts";
import { isUpdated } from "./update.ts";
import { Welcome } from "./welcome.ts";
import { Workbench } from "./workbench.ts";
import { showWorks, Works } from "./works.ts";

const WIRE = 0.18;

const isEmbedded = new URLSearchParams(location.hash.slice(1)).has("embed");
document.body.classList.toggle("embed", isEmbedded);
const store = new Store(() => warn(t("noStore")));
const settings: Settings = {
  speed: "fast",
  language: preferred(navigator.languages),
  theme: "auto",
  wire: WIRE,
  auto: false,
  grid: false,
  plate: true,
  sound: false,
  ...sound(store.settings),
};

const partOf = (text: string): string | undefined =>
  opening.parts.find(({ program, listed }) => text === program || text === listed)?.name;
const works = new Works(
  isEmbedded ? { works: [] } : store,
  (program) => partOf(program) !== undefined || course.isGiven(program),
  tellWorks,
);
const listed = (text: string, program: string): void => course.listed(text, program);
const bench = new Workbench({ works, partOf, listed, isAuto: () => settings.auto, openManual, showDrawing });
const teletype = new Teletype(get("terminal"), { type: (text) => session.type(text), press: (key) => session.press(key) }, "");
const status = new StatusLine(bench, teletype);
const inside = new Inside();
const sounds = new Sound();
bench.stage.pictures.onPlay = (isPlaying) => (sounds.isCutting = isPlaying);
const welcome = new Welcome(bench.stage);
let before = "";
const session = new Session(workerAddress(), teletype, isEmbedded ? undefined : store, {
  state: (state) => {
    if (state === "prompt") finished();
    status.show(state);
  },
  punched: (punched) => {
    bench.punched(punched);
    for (const each of punched) if ("text" in each) sounds.punch(each.text.length);
  },
  printed: (characters) => sounds.print(characters),
  memory: (program) => {
    bench.memory(program, before);
    before = program;
    // (the tape has its program's name now, where both were typed in one go)
    if (session.state === "prompt") finished();
  },
  error: (number, line) => bench.error(number, line),
  strange: ({ character, column }) => say("dropped", character, column),
  look: (look, isHeld) => inside.look(look, isHeld),
  failed: (why) => {
    warn(t("noMachine", why));
    for (const id of ["run", "reset", "send", "machine"]) get<HTMLButtonElement>(id).disabled = true;
  },
});
bench.session = session;
const menu = new SettingsMenu(settings, bench, teletype, (changed) => (store.settings = changed));
const course = new Course(bench);
const opening = new Opening(bench, works, course, (changed) => menu.change(changed));
rove(get("shelf"));
bind(bench, teletype, opening, settings, works);
for (const button of document.querySelectorAll(".pane .close")) button.addEventListener("click", closePane);
onClick("machine", () => void inside.open(session));
for (const [id, word] of [
  ["manual", "manualFile"],
  ["about", "aboutFile"],
] as const) {
  get(id).addEventListener("click", (event) => {
    event.preventDefault();
    openReading(word);
  });
}

/** The machine is at its prompt: the tape is kept for the next visit, a lesson's task is checked. */
function finished(): void {
  if (!isEmbedded) store.tape = bench.stage.recording.kept;
  void welcome.isCut();
  void bench.stage.pictures.measured?.then(() => course.check());
}

/** On a small screen the manual stands in front of it. */
function showDrawing(): void {
  view("drawing");
  if (isSmall() && !get("manual-pane").hidden) closePane();
}

function tellWorks(): void {
  showWorks(works, (work) => opening.work(work));
}

function tellParts(): void {
  showParts(get("part-list"), opening.parts, (part) => {
    welcome.end();
    opening.part(part);
  });
  const there = opening.parts.find(({ program }) => program === bench.editor.text);
  if (there) opening.tell(there);
}

menu.onSound = (isOn, isReal) => {
  sounds.isReal = isReal;
  sounds.isOn = isOn;
};
menu.onLanguage = () => {
  status.retell();
  if (opening.parts.length) tellParts();
  tellWorks();
  bench.refresh();
  turnManual();
  void course.retell();
  inside.retell();
};

async function begin(): Promise<void> {
  view("drawing");
  const last = isEmbedded ? null : store.machine;
  menu.apply({});
  if (!isEmbedded) keepSafe(bench, store, works, tellWorks);
  const reading = readPartList().then(
    (found) => {
      opening.parts = found;
      tellParts();
      tellWorks();
    },
    () => say("noParts"),
  );
  if (!session.start(settings.speed, last, readImages())) warn(t("badKept"));
  if (last?.draft !== undefined) bench.editor.text = last.draft;
  const tape = last && store.tape;
  if (last?.about) works.goOn(last.about.work, last.program);
  bench.origin = last?.about?.origin;
  if (tape) bench.stage.show(tape);
  if (isEmbedded) {
    const full = get<HTMLAnchorElement>("full");
    full.hidden = false;
    full.href = location.href.replace(/&embed\b/, "");
  }
  const walking = readModule("walk.wasm").then(
    (module) => bench.stage.pictures.startWalk(module),
    (error: unknown) => say("noWalk", String(error)),
  );
  await Promise.all([reading, walking]);
  const { isOpened, fault } = await opening.link(location.hash, last?.draft ?? last?.program, last?.about?.link);
  addEventListener("hashchange", () => void opening.link(location.hash).then(({ fault }) => fault?.()));
  if (!isOpened && !last && !isEmbedded) welcome.begin(opening);
  fault?.();
  document.body.dataset["ready"] = String(Math.round(performance.now()));
  if (!isEmbedded) await isUpdated();
}

void begin();
