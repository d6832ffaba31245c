/** The page's buttons and files' doors. */
import { get, onClick } from "./dom.ts";
import { tooLarge } from "./files.ts";
import { copyPicture, film } from "./film.ts";
import { t } from "./language.ts";
import { say } from "./message.ts";
import type { Opening } from "./opening.ts";
import { copyEmbed, copyLink, save } from "./saving.ts";
import { bindShell, view } from "./shell.ts";
import type { Settings } from "./store.ts";
import type { Teletype } from "./teletype.ts";
import type { Workbench } from "./workbench.ts";
import type { Works } from "./works.ts";

export function bind(bench: Workbench, teletype: Teletype, opening: Opening, settings: Settings, works: Works): void {
  bindShell();
  onClick("run", () => (bench.session.isRunning ? bench.session.stop() : void bench.run()));
  // RETURN that is meant for a program that asks is no ctrl-C.
  get("run").addEventListener("keydown", (event) => {
    if (event.key === "Enter" && bench.session.isRunning) event.preventDefault();
  });
  onClick("revert", () => bench.revert());
  onClick("reset", () => bench.session.reset());
  onClick("tear", () => teletype.clear());
  onClick("copy-link", () => void copyLink(bench));
  onClick("copy-embed", () => void copyEmbed(bench));
  const { pictures, recording } = bench.stage;
  const ifDrawn = (use: (name: string) => Promise<void>): void => {
    if (recording.isEmpty) say("noBlocks");
    else void use(recording.made.name);
  };
  onClick("copy-picture", () => ifDrawn((name) => copyPicture(pictures.filmed, name)));
  onClick("film", () => ifDrawn((name) => film(pictures.filmed, name)));
  for (const button of document.querySelectorAll<HTMLElement>("[data-save]")) {
    button.addEventListener("click", () => void save(button.dataset["save"] ?? "", bench, settings, works));
  }
  bindKeys(bench);
  bindDrawing(bench);
  bindFiles(bench, opening);
  document.querySelector(".skip")?.addEventListener("click", (event) => {
    event.preventDefault();
    view("teletype");
    teletype.focus();
  });
}

function bindKeys({ session }: Workbench): void {
  for (const button of document.querySelectorAll<HTMLElement>("[data-key]")) {
    // (who types goes on typing: the teletype keeps the focus, and a phone its keyboard)
    button.addEventListener("mousedown", (event) => event.preventDefault());
    button.addEventListener("click", () => {
      const key = Number(button.dataset["key"]);
      if (key === 13 || key === 127) session.type(String.fromCharCode(key));
      else session.press(key);
    });
  }
}

function bindDrawing({
  stage: {
    pictures: { drawing },
  },
}: Workbench): void {
  onClick("fit", () => drawing.fit());
  onClick("closer", () => drawing.zoom(1.5));
  onClick("farther", () => drawing.zoom(1 / 1.5));
  onClick("before", () => drawing.step(-1));
  onClick("next", () => drawing.step(1));
  get<HTMLDetailsElement>("legend").open = !matchMedia("(max-width: 560px)").matches;
  const button = get("measure");
  const millimetres = (micrometres: number): string => (micrometres / 1000).toFixed(3);
  onClick("measure", () => {
    drawing.isMeasuring = !drawing.isMeasuring;
    button.ariaPressed = String(drawing.isMeasuring);
  });
  drawing.onPoint = (place, from) => {
    const words: string[] = [];
    if (place) words.push(t("where", millimetres(place[0]), millimetres(place[1])));
    if (place && from) {
      const [dx, dy] = [place[0] - from[0], place[1] - from[1]];
      words.push(t("measured", millimetres(Math.hypot(dx, dy)), millimetres(dx), millimetres(dy)));
    }
    get("place").textContent = words.join("  ");
  };
}

function bindFiles({ session }: Workbench, opening: Opening): void {
  const picker = get<HTMLInputElement>("file");
  let picked = (file: File): void => void opening.file(file);
  const pick = (use: (file: File) => void): void => {
    picked = use;
    picker.value = "";
    picker.click();
  };
  const typeFile = async (file: File): Promise<void> => {
    const large = tooLarge(file.name, file.size);
    if (large?.kind === "refused") say(large.why, ...large.values);
    else session.type(await file.text());
  };
  picker.addEventListener("change", () => {
    const [file] = picker.files ?? [];
    if (file) picked(file);
  });
  onClick("open", () => pick((file) => void opening.file(file)));
  onClick("send", () => pick((file) => void typeFile(file)));
  addEventListener("dragover", (event) => event.preventDefault());
  addEventListener("drop", (event: DragEvent) => {
    event.preventDefault();
    const [file] = event.dataTransfer?.files ?? [];
    if (file) void opening.file(file);
  });
}
