/** The drawing on the screen: puts its parts together. */
import walkBytes from "../../wasm/walk.wasm";
import { get, onClick } from "../dom.ts";
import { inPresent } from "../language.ts";
import { hide, show } from "../message.ts";
import { bindShell, view } from "../shell.ts";
import { Actions } from "./actions.ts";
import { Appearance } from "./appearance.ts";
import { Canvas } from "./canvas.ts";
import { Cutting } from "./cutting.ts";
import { Decisions } from "./decide.ts";
import { Desk } from "./desk.ts";
import { countRepairs, withoutRepairs } from "./edits.ts";
import { Fields } from "./fields.ts";
import { Keys } from "./keys.ts";
import { shown } from "./look.ts";
import { MachineFields } from "./machine.ts";
import { MatchList } from "./matches.ts";
import { Menu } from "./menu.ts";
import { PartFields } from "./part.ts";
import { Report } from "./report.ts";
import { Results } from "./result.ts";
import { Saving } from "./saving.ts";
import { Gone, Refusal, Server } from "./server.ts";
import { SetupBar } from "./setups.ts";
import { TellTale } from "./told.ts";
import { Tree } from "./tree.ts";
import { visible } from "./visible.ts";
import { asksForWire } from "./wire.ts";
import { type Word, w } from "./words.ts";

/** No larger file is read, bytes. */
const MOST = 64 * 1024 * 1024;

const server = new Server(takeToken());
const desk = new Desk(server);
const canvas = new Canvas(get("base"), get("over"), desk, server);
const cutting = new Cutting(desk, server);
const actions = new Actions(desk);
const tree = new Tree(get("tree"), desk);
const matches = new MatchList(desk);
const fields = new Fields(desk, show);
const machine = new MachineFields(desk, show);
const part = new PartFields(desk, show);
const told = new TellTale(desk, cutting, canvas.ways);
const decisions = new Decisions(desk, canvas, told);
const report = new Report(desk, told, (line) => decisions.look(line));
const saving = new Saving(desk, cutting, server);
const results = new Results(cutting, server, canvas, told, saving, new WebAssembly.Module(walkBytes));
const setups = new SetupBar(desk, server, saving);
const menu = new Menu(desk, actions);
const appearance = new Appearance(
  () => {
    fields.name();
    machine.name();
    part.name();
    setups.show();
    matches.show();
    tree.name();
    results.name();
    canvas.sayMeasured();
    say();
  },
  (colours) => {
    canvas.colours = colours;
  },
);
const cut = async (): Promise<void> => {
  if (takeTyped() && (await asksForWire(desk, told))) void cutting.start();
};
const saveAll = (isNew = false): void => {
  if (takeTyped()) void saving.save(isNew);
};
const pick = (): void => get<HTMLInputElement>("file").click();

/** The key of the server: out of the address, where others may see it, or what this tab had when it was loaded before. */
function takeToken(): string {
  const told = new URLSearchParams(location.hash.slice(1)).get("token");
  if (told === null) return sessionStorage.getItem("token") ?? "";
  sessionStorage.setItem("token", told);
  history.replaceState(null, "", location.pathname);
  return told;
}

/** Takes what is still being typed; false where a field holds what cannot be read: it gets the caret. */
function takeTyped(): boolean {
  const { activeElement } = document;
  // (a field is read when it loses the caret)
  if (activeElement instanceof HTMLInputElement) {
    activeElement.blur();
    activeElement.focus();
  }
  const refused = document.querySelector<HTMLInputElement>(".field [aria-invalid=true]");
  if (!refused) return true;
  for (const id of ["part", "more"]) get<HTMLDetailsElement>(id).open ||= get(id).contains(refused);
  refused.focus();
  show(w("badField", refused.labels?.[0]?.textContent ?? refused.ariaLabel ?? "", refused.value));
  return false;
}

/** The header and what depends on the job. */
function say(): void {
  const { state, isReadAgain } = desk;
  get("name").textContent = visible(state?.name ?? "");
  get("size").textContent = state?.contours.length ? w("sizeOf", ...state.size.map(shown)) : "";
  get("again").textContent = state?.error && state.contours.length ? w("readBefore") : isReadAgain ? w("readAgain") : "";
  get("empty").hidden = state !== undefined;
  get<HTMLButtonElement>("undo").disabled = !desk.canUndo;
  get<HTMLButtonElement>("redo").disabled = !desk.canRedo;
  get<HTMLButtonElement>("cut").disabled = get<HTMLButtonElement>("save").disabled = !state || desk.isGone;
  document.body.dataset["settled"] = String(desk.isSettled);
  const repairs = countRepairs(desk.edited);
  get("repairs").hidden = !repairs;
  get("repair-count").textContent = String(repairs);
  report.show();
  decisions.show();
  void results.show();
}

async function open(file: File): Promise<void> {
  if (file.size > MOST) {
    show(w("tooLarge", file.name));
    return;
  }
  show(w("reading", file.name));
  try {
    await desk.open(file.name, file);
    hide();
  } catch (error) {
    if (!(error instanceof Refusal || error instanceof Gone)) throw error;
    show(error instanceof Refusal ? inPresent(error.fault.message) : w("gone"));
  }
}

function bind(): void {
  cutting.onChange = canvas.onWays = say;
  desk.onStale = () => show(w("stale"));
  desk.onRefused = ({ fault }) => show(inPresent(fault.message));
  desk.onChange((news) => {
    // (units, layers and the like may help a drawing that cannot be read)
    if (news.has("drawing") && desk.state?.error) get<HTMLDetailsElement>("more").open = true;
    if (news.has("server") && desk.isGone) show(w(desk.state?.can_save === false ? "goneDropped" : "gone"));
    else if (news.has("server")) hide();
    say();
  });
  canvas.onPoint = (place) => {
    get("place").textContent = place ? w("where", ...place.map((each) => each.toFixed(3))) : "";
  };
  canvas.onMenu = tree.onMenu = (id, x, y) => menu.open(id, x, y);
  tree.onOrder = (id, other) => actions.orderBefore(id, other);
  const hint = (word: Word | undefined): void => (word ? show(w(word)) : hide());
  new Keys(desk, canvas, actions, {
    cut: () => void cut(),
    save: () => saveAll(),
    open: pick,
    menu: (id, x, y) => menu.open(id, x, y),
    hint,
  });
  onClick("cut", () => void cut());
  onClick("cancel", () => void cutting.cancel());
  onClick("save", () => saveAll());
  onClick("save-new", () => saveAll(true));
  onClick("undo", () => desk.undo());
  onClick("redo", () => desk.redo());
  canvas.onMeasured = (text) => {
    get("measure").ariaPressed = String(text !== undefined);
    get("measured").textContent = text ?? "";
  };
  onClick("measure", () => {
    canvas.isMeasuring = !canvas.isMeasuring;
  });
  onClick("no-repairs", () => desk.edit(withoutRepairs(desk.edited)));
  onClick("alike", () => actions.alike());
  onClick("box", () => {
    canvas.isBoxing = !canvas.isBoxing;
    get("box").ariaPressed = String(canvas.isBoxing);
  });
  onClick("fit", () => canvas.fit());
  onClick("closer", () => canvas.zoom(1.5));
  onClick("farther", () => canvas.zoom(1 / 1.5));
  bindFiles();
  bindShell();
}

function bindFiles(): void {
  const picker = get<HTMLInputElement>("file");
  picker.addEventListener("change", () => {
    const [file] = picker.files ?? [];
    picker.value = "";
    if (file) void open(file);
  });
  onClick("open", pick);
  onClick("open-first", pick);
  addEventListener("dragover", (event) => event.preventDefault());
  addEventListener("drop", (event: DragEvent) => {
    event.preventDefault();
    const [file] = event.dataTransfer?.files ?? [];
    if (file) void open(file);
  });
}

async function begin(): Promise<void> {
  bind();
  appearance.speak();
  appearance.paint();
  view("drawing");
  document.body.dataset["ready"] = String(Math.round(performance.now()));
  void setups.begin();
  try {
    await desk.listen();
  } catch (error) {
    if (error instanceof Gone) show(w("gone"));
    else if (error instanceof Refusal)
      show(error.status === 401 || error.status === 403 ? w("noToken") : inPresent(error.fault.message));
    else throw error;
  }
}

void begin();
