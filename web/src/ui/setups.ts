/** Setups that are kept: chosen by a click, kept under a name, removed. */
import { get, make, onClick } from "../dom.ts";
import { inPresent } from "../language.ts";
import { ask, show } from "../message.ts";
import type { Desk } from "./desk.ts";
import { withTables } from "./edits.ts";
import { same } from "./inputs.ts";
import type { Saving } from "./saving.ts";
import { Gone, Refusal, type Server } from "./server.ts";
import type { Setup, Setups, Tables } from "./types.ts";
import { visible } from "./visible.ts";
import { w } from "./words.ts";

export class SetupBar {
  readonly #desk: Desk;
  readonly #server: Server;
  readonly #saving: Saving;
  readonly #select = get<HTMLSelectElement>("setup");
  #known: Setups = { setups: [], last: "", keys: {} };

  constructor(desk: Desk, server: Server, saving: Saving) {
    this.#desk = desk;
    this.#server = server;
    this.#saving = saving;
    this.#select.addEventListener("change", () => void this.#choose(this.#select.value));
    onClick("setups-open", () => this.#open());
    onClick("setups-keep", () => void this.#keep());
    onClick("setups-close", () => get<HTMLDialogElement>("setups").close());
    get("setups-name").addEventListener("keydown", (event) => {
      if (event.key !== "Enter") return;
      event.preventDefault();
      void this.#keep();
    });
    desk.onChange(() => this.show());
  }

  /** Asks which there are; a damaged one that was chosen last is told of. */
  async begin(): Promise<void> {
    try {
      this.#known = await this.#server.setups();
    } catch (error) {
      // (who is not answered is told so by what asks for the drawing)
      if (error instanceof Gone || error instanceof Refusal) return;
      throw error;
    }
    this.show();
    const { last } = this.#known;
    const damaged = this.#known.setups.find(({ name, error }) => name === last && error);
    if (damaged?.error) show(inPresent(damaged.error.message));
  }

  /** The keys of a setup, as the job has them. */
  #own(): Tables {
    const { job } = this.#desk.edited;
    const tables = Object.entries(this.#known.keys).map(([table, keys]) => {
      const found = (job[table as keyof typeof job] ?? {}) as Readonly<Record<string, unknown>>;
      return [table, Object.fromEntries(keys.filter((key) => key in found).map((key) => [key, found[key]]))] as const;
    });
    return Object.fromEntries(tables);
  }

  /** The setup that the job is as: of several the one that was chosen last. */
  get #present(): Setup | undefined {
    const own = this.#own();
    const isSame = ({ tables }: Setup): boolean =>
      tables !== undefined &&
      Object.entries(this.#known.keys).every(([table, keys]) =>
        keys.every((key) => same(tables[table]?.[key], own[table]?.[key])),
      );
    const alike = this.#known.setups.filter(isSame);
    return alike.find(({ name }) => name === this.#known.last) ?? alike[0];
  }

  show(): void {
    const options = this.#known.setups.map(({ name, error }) => {
      const option = make("option", "", visible(name));
      option.value = name;
      option.disabled = error !== undefined;
      return option;
    });
    const own = make("option", "", w("setupOwn"));
    own.value = "";
    this.#select.replaceChildren(own, ...options);
    this.#select.value = this.#present?.name ?? "";
    this.#select.disabled = !this.#desk.state;
  }

  async #choose(name: string): Promise<void> {
    const tables = this.#known.setups.find((each) => each.name === name)?.tables;
    if (tables) this.#desk.edit(withTables(this.#desk.edited, this.#known.keys, tables));
    await this.#tried(() => this.#server.useSetup(name));
  }

  #open(): void {
    get<HTMLInputElement>("setups-name").value = this.#present?.name ?? "";
    this.#list();
    get<HTMLDialogElement>("setups").showModal();
    get<HTMLInputElement>("setups-name").select();
  }

  /** The setups in the dialog, each to be removed. */
  #list(): void {
    const rows = this.#known.setups.map(({ name, error }) => {
      const row = make("li", "");
      const remove = make("button", "", "×");
      remove.type = "button";
      remove.ariaLabel = remove.title = w("setupDrop", name);
      remove.addEventListener("click", () => void this.#drop(name));
      const told = make("span", error ? "wrong" : "", error ? inPresent(error.message) : visible(name));
      row.append(told, remove);
      return row;
    });
    get("setups-list").replaceChildren(...rows);
    if (!this.#desk.state) get("setups-list").prepend(make("li", "", w("setupNoDrawing")));
    get<HTMLButtonElement>("setups-keep").disabled = !this.#desk.state;
  }

  async #keep(): Promise<void> {
    const name = get<HTMLInputElement>("setups-name").value.trim();
    const tables = { ...this.#own(), tape: this.#saving.form };
    const keep = (isOver: boolean) => this.#server.keepSetup(name, tables, isOver);
    const isKept = await this.#tried(async () => {
      try {
        return await keep(false);
      } catch (error) {
        if (!(error instanceof Refusal) || !error.exists.length) throw error;
        return (await ask(w("askOverwrite", name), w("overwrite"))) ? keep(true) : undefined;
      }
    });
    if (!isKept) return;
    get<HTMLDialogElement>("setups").close();
    // (the job has what is kept: what the tape was saved as, too)
    const kept = this.#known.setups.find((each) => each.name === name)?.tables;
    if (kept && this.#present?.name !== name) this.#desk.edit(withTables(this.#desk.edited, this.#known.keys, kept));
    show(w("setupKept", name));
  }

  async #drop(name: string): Promise<void> {
    if (await ask(w("askDrop", name), w("dropIt"))) await this.#tried(() => this.#server.dropSetup(name));
    this.#list();
  }

  /** Takes what the server has then; what it refuses is said, and false. */
  async #tried(call: () => Promise<Setups | undefined>): Promise<boolean> {
    try {
      const known = await call();
      if (known) this.#known = known;
      this.show();
      return known !== undefined;
    } catch (error) {
      if (!(error instanceof Gone || error instanceof Refusal)) throw error;
      const text = error instanceof Refusal ? inPresent(error.fault.message) : w("gone");
      if (get<HTMLDialogElement>("setups").open) get("setups-hint").textContent = text;
      else show(text);
      return false;
    }
  }
}
