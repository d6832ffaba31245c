/** The job on the desk: the drawing as the server has read it, its settings, the plan, the selection; undo and redo. */
import { type Edited, edited, moved, type Scope } from "./edits.ts";
import { edgesOf, type Shape, shapeOf } from "./geometry.ts";
import { Gone, Refusal, type Server } from "./server.ts";
import type { Contour, Empty, Later, Note, Plan, Planned, State } from "./types.ts";

/** The thing that has changed. */
export type News = "drawing" | "job" | "plan" | "selection" | "server";

/** Steps that can be undone. */
const STEPS = 500;
/** Between two attempts to reach a server that is gone, ms. */
const AGAIN = 2000;

const NO_PLAN: Plan = { order: [], said: [], contours: {} };
const NO_JOB: Edited = { job: { schema: 1, drawing: "", sha256: "" }, ids: [] };

export class Desk {
  readonly #server: Server;
  readonly #listeners: ((news: ReadonlySet<News>) => void)[] = [];
  #state: State | undefined;
  #rev = 0;
  #edited = NO_JOB;
  /** The job that the server has. */
  #sent = NO_JOB;
  #undo: Edited[] = [];
  #redo: Edited[] = [];
  #joined = "";
  #sending: Promise<void> | undefined;
  #polling: AbortController | undefined;
  #scope: Scope = "all";
  plan: Plan = NO_PLAN;
  contours: ReadonlyMap<number, Contour> = new Map();
  shapes: ReadonlyMap<number, Shape> = new Map();
  /** What is not cut: edges in µm, and what is written. */
  left: { readonly edges: readonly (readonly number[])[]; readonly notes: readonly Note[] } = { edges: [], notes: [] };
  isGone = false;
  /** The drawing's file has changed since it was opened. */
  isReadAgain = false;
  /** Says that another tab was faster, or that the server refuses. */
  onStale: () => void = () => undefined;
  onRefused: (refusal: Refusal) => void = () => undefined;

  constructor(server: Server) {
    this.#server = server;
  }

  get state(): State | undefined {
    return this.#state;
  }

  get rev(): number {
    return this.#rev;
  }

  get edited(): Edited {
    return this.#edited;
  }

  get scope(): Scope {
    return this.#scope;
  }

  /** Contours that are chosen, a layer's among them. */
  get chosen(): readonly number[] {
    const scope = this.#scope;
    if (scope === "all") return [];
    if ("contours" in scope) return scope.contours;
    return this.#state?.layers.find(({ name }) => name === scope.layer)?.contours ?? [];
  }

  get canUndo(): boolean {
    return this.#undo.length > 0;
  }

  get canRedo(): boolean {
    return this.#redo.length > 0;
  }

  /** All changes have reached the server, and the plan is theirs. */
  get isSettled(): boolean {
    return this.#edited === this.#sent;
  }

  planned(id: number): Planned | undefined {
    return this.plan.contours[String(id)];
  }

  onChange(listener: (news: ReadonlySet<News>) => void): void {
    this.#listeners.push(listener);
  }

  #tell(...news: News[]): void {
    const set = new Set(news);
    for (const listener of this.#listeners) listener(set);
  }

  choose(scope: Scope): void {
    this.#scope = "object" === typeof scope && "contours" in scope && !scope.contours.length ? "all" : scope;
    this.#tell("selection");
  }

  /** Takes a changed job; `joined`: changes of the same name are one step of undo. */
  edit(after: Edited, joined = ""): void {
    if (after === this.#edited) return;
    if (!joined || joined !== this.#joined) this.#undo = [...this.#undo.slice(-STEPS), this.#edited];
    this.#joined = joined;
    this.#redo = [];
    this.#take(after);
  }

  /** The next change is a step of its own. */
  endJoined(): void {
    this.#joined = "";
  }

  undo(): void {
    this.#swap(this.#undo, this.#redo);
  }

  redo(): void {
    this.#swap(this.#redo, this.#undo);
  }

  #swap(from: Edited[], to: Edited[]): void {
    const last = from.pop();
    if (!last) return;
    to.push(this.#edited);
    this.#joined = "";
    this.#take(last);
  }

  #take(after: Edited): void {
    this.#edited = after;
    this.#tell("job");
    void this.settle();
  }

  /** Brings all changes to the server. */
  settle(): Promise<void> {
    if (this.isSettled) return this.#sending ?? Promise.resolve();
    this.#polling?.abort();
    this.#sending ??= this.#send().finally(() => {
      this.#sending = undefined;
    });
    return this.#sending;
  }

  async #send(): Promise<void> {
    while (!this.isSettled) {
      const wanted = this.#edited;
      try {
        const answer = await this.#server.put(this.#rev, wanted.job);
        this.#alive();
        const { plan } = answer;
        const whole = answer.contours ? plan : { ...plan, contours: { ...this.plan.contours, ...plan.contours } };
        this.#adopt({ ...answer, plan: whole, name: this.#state?.name ?? "" }, wanted);
      } catch (error) {
        if (!(error instanceof Refusal)) {
          this.#lose(error);
          return;
        }
        if (error.state) {
          this.#undo = this.#redo = [];
          this.#adopt(error.state);
          this.onStale();
        } else {
          // (the job as it was before is the last that can be had)
          this.#edited = this.#sent;
          this.#undo.pop();
          this.#tell("job");
          this.onRefused(error);
        }
      }
    }
  }

  /** Opens another drawing. */
  async open(name: string, bytes: Blob): Promise<void> {
    this.#polling?.abort();
    const state = await this.#server.open(name, bytes);
    this.#undo = this.#redo = [];
    this.#scope = "all";
    this.#adopt(state);
    this.isReadAgain = false;
    this.#tell("job");
  }

  /** Takes a job that lies beside the drawing, or leaves it. */
  async take(name: string, isWanted: boolean): Promise<void> {
    this.#polling?.abort();
    this.#adopt(await this.#server.take(name, isWanted));
    this.#tell("job");
  }

  /** Takes what the server has; `ours`: the job that it answers to. */
  #adopt(later: State | Later | Empty | undefined, ours?: Edited): void {
    if (!later) return;
    this.#rev = later.rev;
    if (later.name === null) {
      this.#tell("server");
      return;
    }
    const before = this.#state;
    // (a drawing that cannot be read has no plan, one of which nothing is known no job)
    const { plan = NO_PLAN, job = NO_JOB.job, error = null } = later;
    const state = { ...before, ...later, plan: plan ?? NO_PLAN, job: job ?? NO_JOB.job, error } as State;
    const fresh = edited(state.job, state.matches);
    const isBehind = ours !== undefined && ours !== this.#edited;
    this.#state = state;
    this.#sent = isBehind ? ours : fresh;
    if (!isBehind) this.#edited = fresh;
    else if (later.contours) this.#edited = moved(this.#edited, fresh, state.contours);
    this.plan = state.plan;
    // (of a drawing that could not be read there is no sum)
    if (before?.name === state.name && before.sha256 && state.sha256 && before.sha256 !== state.sha256) this.isReadAgain = true;
    if (before?.contours === state.contours) {
      this.#tell("job", "plan");
      return;
    }
    if (before?.sha256 !== state.sha256 || before.contours.length !== state.contours.length) this.#scope = "all";
    if (!ours) this.#undo = this.#redo = [];
    this.contours = new Map(state.contours.map((contour) => [contour.id, contour]));
    this.shapes = new Map(state.contours.map((contour) => [contour.id, shapeOf(contour)]));
    this.left = { edges: edgesOf(state.left?.edges ?? []), notes: state.left?.notes ?? [] };
    this.#tell("drawing", "selection", "job", "plan");
  }

  #alive(): void {
    if (!this.isGone) return;
    this.isGone = false;
    this.#tell("server");
  }

  #lose(error: unknown): void {
    if (!(error instanceof Gone)) throw error;
    if (this.isGone) return;
    this.isGone = true;
    this.#tell("server");
  }

  /** Hears of changes that others make: another tab, or who saves the drawing; comes back when the page may not ask. */
  async listen(): Promise<void> {
    this.#adopt(await this.#server.state());
    for (;;) {
      await this.settle();
      const polling = new AbortController();
      this.#polling = polling;
      try {
        const state = await this.#server.later(this.#rev, this.#state?.drawn, polling.signal);
        this.#alive();
        if (this.isSettled && !this.#sending && !polling.signal.aborted) this.#adopt(state);
      } catch (error) {
        if (polling.signal.aborted) continue;
        if (error instanceof Refusal) throw error;
        this.#lose(error);
        await new Promise((resume) => setTimeout(resume, AGAIN));
      }
    }
  }
}
