/** The settings and the menu where they are changed. */
import { get } from "./dom.ts";
import { type Language, speak, t } from "./language.ts";
import type { Settings, Theme } from "./store.ts";
import type { Teletype } from "./teletype.ts";
import { onSystemTheme, paint } from "./theme.ts";
import type { Workbench } from "./workbench.ts";

/** Settings of two values. */
const CHOICES = ["auto", "grid", "plate", "sound"] as const;

/** Takes from what was kept or brought in what is a setting, and nothing else. */
export function sound(found: Partial<Settings>): Partial<Settings> {
  const { speed, language, theme, wire } = found;
  return {
    ...(speed === "fast" || speed === "real" ? { speed } : {}),
    ...(language === "en" || language === "zh" ? { language } : {}),
    ...(theme === "auto" || theme === "light" || theme === "dark" ? { theme } : {}),
    ...(typeof wire === "number" && wire >= 0 && wire <= 5 ? { wire } : {}),
    ...Object.fromEntries(CHOICES.filter((name) => typeof found[name] === "boolean").map((name) => [name, found[name]])),
  };
}

export class SettingsMenu {
  readonly settings: Settings;
  readonly #bench: Workbench;
  readonly #teletype: Teletype;
  /** Called when the language has changed: who writes of himself writes anew. */
  onLanguage: () => void = () => undefined;
  /** Called with what is to be heard: anything, and the machine at its own speed. */
  onSound: (isOn: boolean, isReal: boolean) => void = () => undefined;

  readonly #keep: (changed: Partial<Settings>) => void;

  constructor(settings: Settings, bench: Workbench, teletype: Teletype, keep: (changed: Partial<Settings>) => void) {
    this.settings = settings;
    this.#bench = bench;
    this.#teletype = teletype;
    this.#keep = keep;
    const on = (id: string, read: (element: HTMLInputElement) => Partial<Settings>): void =>
      get(id).addEventListener("change", () => this.change(read(get<HTMLInputElement>(id))));
    on("speed", ({ value }) => ({ speed: value as Settings["speed"] }));
    on("language", ({ value }) => ({ language: value }));
    on("theme", ({ value }) => ({ theme: value as Theme }));
    on("wire", ({ valueAsNumber }) => ({ wire: valueAsNumber || 0 }));
    for (const name of CHOICES) on(name, ({ checked }) => ({ [name]: checked }));
    onSystemTheme(() => this.#paint());
  }

  /** Puts settings in force, for the next visit too. */
  change(changed: Partial<Settings>): void {
    this.apply(changed);
    this.#keep(sound(changed));
  }

  apply(changed: Partial<Settings>): void {
    const { settings } = this;
    Object.assign(settings, sound(changed));
    for (const id of ["speed", "language", "theme"] as const) get<HTMLSelectElement>(id).value = settings[id];
    for (const id of CHOICES) get<HTMLInputElement>(id).checked = settings[id];
    get<HTMLInputElement>("wire").value = String(settings.wire);
    this.#bench.session.speed(settings.speed);
    const { editor } = this.#bench;
    const { pictures } = this.#bench.stage;
    pictures.drawing.wireWidth = settings.wire;
    pictures.drawing.grid = settings.grid;
    pictures.isPlate = settings.plate;
    this.onSound(settings.sound, settings.speed === "real");
    speak(settings.language as Language, document);
    this.#teletype.name = t("teletype");
    editor.name = t("editor");
    pictures.retell();
    this.onLanguage();
    this.#paint();
  }

  #paint(): void {
    const colour = paint(this.settings.theme);
    const { pictures } = this.#bench.stage;
    pictures.drawing.colours = {
      wire: colour("wire"),
      lead: colour("lead"),
      chosen: colour("mark"),
      walk: colour("walk"),
      ruler: colour("dim"),
      grid: colour("grid"),
    };
    this.#teletype.theme = {
      background: colour("panel"),
      foreground: colour("text"),
      cursor: colour("strong"),
      cursorAccent: colour("panel"),
      selectionBackground: colour("chosen"),
      selectionForeground: colour("chosen-text"),
    };
    pictures.plate.steel = {
      light: colour("steel"),
      dark: colour("steel-dark"),
      kerf: colour("kerf"),
      floor: colour("panel"),
      spark: colour("spark"),
    };
    pictures.punched.colours = { paper: colour("tape"), hole: colour("hole"), mark: colour("walk") };
    pictures.say();
  }
}
