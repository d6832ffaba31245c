/** The page's language and colours, as they are chosen and kept. */
import { get } from "../dom.ts";
import { type Language, preferred, speak } from "../language.ts";
import { sound } from "../settings.ts";
import { Store, type Theme } from "../store.ts";
import { onSystemTheme, paint } from "../theme.ts";
import type { Colours } from "./sketch.ts";
import { find } from "./words.ts";

export class Appearance {
  readonly #store = new Store(() => undefined);
  readonly #named: () => void;
  readonly #painted: (colours: Colours) => void;
  #language: Language;
  #theme: Theme;

  /** `named`: who writes of himself does so in the present language; `painted`: who draws takes these colours. */
  constructor(named: () => void, painted: (colours: Colours) => void) {
    this.#named = named;
    this.#painted = painted;
    const kept = sound(this.#store.settings);
    this.#language = kept.language === "zh" || kept.language === "en" ? kept.language : preferred(navigator.languages);
    this.#theme = kept.theme ?? "auto";
    const [language, theme] = [get<HTMLSelectElement>("language"), get<HTMLSelectElement>("theme")];
    language.value = this.#language;
    theme.value = this.#theme;
    language.addEventListener("change", () => {
      this.#language = language.value as Language;
      this.#store.settings = { language: this.#language };
      this.speak();
    });
    theme.addEventListener("change", () => {
      this.#theme = theme.value as Theme;
      this.#store.settings = { theme: this.#theme };
      this.paint();
    });
    onSystemTheme(() => this.paint());
  }

  speak(): void {
    speak(this.#language, document, find);
    this.#named();
  }

  paint(): void {
    const colour = paint(this.#theme);
    this.#painted({
      wire: colour("wire"),
      lead: colour("lead"),
      chosen: colour("mark"),
      walk: colour("walk"),
      ruler: colour("dim"),
      wrong: colour("wrong"),
      panel: colour("panel"),
      text: colour("text"),
    });
  }
}
