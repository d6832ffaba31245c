/** The run that makes the tape: begun, followed, cancelled. */
import type { Desk } from "./desk.ts";
import { Gone, Refusal, type Server, same } from "./server.ts";
import type { Fault, Result, Run } from "./types.ts";

export type Outcome =
  | { kind: "none" }
  | { kind: "running"; run: Run | undefined }
  | { kind: "done"; result: Result }
  | { kind: "failed"; fault: Fault }
  | { kind: "cancelled" };

export class Cutting {
  readonly #desk: Desk;
  readonly #server: Server;
  #rev: number | undefined;
  /** The run, if this page began it. */
  #cut = "";
  /** The run that is followed: its number on the server. */
  run: number | undefined;
  /** The cut that is wanted: one that was cancelled before the server had begun it is none. */
  #begun: object | undefined;
  outcome: Outcome = { kind: "none" };
  /** Called whenever the outcome is another one. */
  onChange: () => void = () => undefined;

  constructor(desk: Desk, server: Server) {
    this.#desk = desk;
    this.#server = server;
    desk.onChange((news) => {
      if (news.has("drawing")) this.#another();
    });
  }

  /** The tape is not of the job that is seen. */
  get isOld(): boolean {
    return !this.#desk.isSettled || (this.#rev !== this.#desk.rev && this.#cut !== this.#seen);
  }

  /** The drawing and the job that is seen, without the form in which the control takes the tape. */
  get #seen(): string {
    const { tape: _, ...job } = this.#desk.edited.job;
    return JSON.stringify([this.#desk.state?.drawn, job]);
  }

  /** There is a tape of the job that is seen. */
  get isDone(): boolean {
    return this.outcome.kind === "done" && !this.isOld;
  }

  get isRunning(): boolean {
    return this.outcome.kind === "running";
  }

  async start(): Promise<void> {
    if (this.isRunning || !this.#desk.state) return;
    this.run = undefined;
    const begun = {};
    this.#begun = begun;
    this.#tell({ kind: "running", run: undefined });
    try {
      await this.#desk.settle();
      if (this.#begun !== begun) return;
      this.#rev = this.#desk.rev;
      this.#cut = this.#seen;
      const run = await this.#server.cut(this.#rev);
      if (this.#begun !== begun) return await this.#server.cancel(run);
      this.run = run;
      await this.#follow(this.run);
    } catch (error) {
      if (this.#begun === begun) this.#fail(error);
    }
  }

  async cancel(): Promise<void> {
    if (this.run === undefined) {
      // (the server has not begun it yet)
      this.#begun = undefined;
      this.#tell({ kind: "cancelled" });
      return;
    }
    try {
      await this.#server.cancel(this.run);
    } catch (error) {
      this.#fail(error);
    }
  }

  /** Another drawing, or the page was loaded again: the server knows of the last run. */
  #another(): void {
    const { state } = this.#desk;
    if (this.isRunning) return;
    if (state?.run === undefined || state.run === null) {
      this.run = undefined;
      this.#tell({ kind: "none" });
    } else if (state.run !== this.run) {
      this.run = state.run;
      this.#rev = state.run_rev ?? undefined;
      this.#cut = "";
      this.#follow(state.run).catch((error: unknown) => this.#fail(error));
    }
  }

  async #follow(number: number): Promise<void> {
    let run = await this.#server.run(number);
    while (run.state === "running") {
      this.#tell({ kind: "running", run });
      run = await this.#server.run(number, run.k);
    }
    if (number !== this.run) return;
    if (run.state === "done" && run.result) this.#tell({ kind: "done", result: run.result });
    else if (run.state === "cancelled") this.#tell({ kind: "cancelled" });
    else this.#tell({ kind: "failed", fault: run.error ?? { message: same(run.state) } });
  }

  #fail(error: unknown): void {
    if (!(error instanceof Refusal || error instanceof Gone)) throw error;
    this.#tell({ kind: "failed", fault: error instanceof Refusal ? error.fault : { message: same(error.message) } });
  }

  #tell(outcome: Outcome): void {
    this.outcome = outcome;
    this.onChange();
  }
}
