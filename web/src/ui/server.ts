/** The calls to the server of `skg ui`. */
import { spoken } from "../language.ts";
import type {
  Empty,
  Fault,
  FileKind,
  Job,
  Later,
  Member,
  Named,
  Put,
  Run,
  Said,
  Setups,
  State,
  Style,
  Tables,
  Ways,
} from "./types.ts";

/** The server refused, and said why. */
export class Refusal extends Error {
  constructor(
    readonly status: number,
    readonly fault: Fault,
    readonly state: State | undefined,
    readonly exists: readonly string[],
  ) {
    super(fault.message[0]);
  }
}

/** Nobody answers. */
export class Gone extends Error {}

export class Server {
  readonly #token: string;

  constructor(token: string) {
    this.#token = token;
  }

  /** The state now. */
  async state(): Promise<State | Empty> {
    return this.#json("GET", "state");
  }

  /** The state once it is another than `after`, without the drawing where that is still `drawn`; undefined: it has not changed
   * for a while. */
  async later(after: number, drawn: number | undefined, signal: AbortSignal): Promise<Later | Empty | undefined> {
    const query = `state?after=${after}${drawn === undefined ? "" : `&drawn=${drawn}`}`;
    const response = await this.#call("GET", query, undefined, { signal });
    return response.status === 204 ? undefined : ((await response.json()) as Later | Empty);
  }

  async open(name: string, bytes: Blob): Promise<State> {
    const response = await this.#call("POST", "open", bytes, { headers: { "X-Name": encodeURIComponent(name) } });
    return (await response.json()) as State;
  }

  async put(rev: number, job: Job): Promise<Put> {
    return this.#json("PUT", "job", { rev, job });
  }

  async ways(rev: number, ids: readonly number[]): Promise<Ways> {
    return (await this.#json<{ ways: Ways }>("POST", "ways", { rev, ids })).ways;
  }

  async cut(rev: number): Promise<number> {
    return (await this.#json<{ run: number }>("POST", "cut", { rev })).run;
  }

  async run(run: number, after?: number): Promise<Run> {
    return this.#json("GET", after === undefined ? `run/${run}` : `run/${run}?after=${after}`);
  }

  async cancel(run: number): Promise<void> {
    await this.#call("DELETE", `run/${run}`);
  }

  async file(run: number, what: FileKind | "sheet.svg", member: Member): Promise<Blob> {
    return (await this.#call("GET", `run/${run}/${what}?language=${spoken()}&member=${member}`)).blob();
  }

  /** The job as a file, cut or not. */
  async job(): Promise<Blob> {
    return (await this.#call("GET", "job")).blob();
  }

  /** The job of a run, with the form in which its tape is saved. */
  async jobOf(run: number, { style, short }: Named): Promise<Blob> {
    return (await this.#call("GET", `run/${run}/job?style=${style}&short=${short}`)).blob();
  }

  /** Writes files beside the drawing: their names. */
  async save(run: number | null, what: readonly FileKind[], overwrite: boolean, named: Named): Promise<string[]> {
    return (await this.#json<{ written: string[] }>("POST", "save", { run, what, overwrite, language: spoken(), ...named }))
      .written;
  }

  /** The tape of a run in a style, from a block on. */
  async tape(run: number, style: Style, member: Member, first = 1): Promise<Blob> {
    return (await this.#call("GET", `run/${run}/from/${first}?style=${style}&member=${member}`)).blob();
  }

  /** Takes a job that lies beside the drawing, or leaves it. */
  async take(name: string, take: boolean): Promise<State> {
    return this.#json("POST", "take", { name, take });
  }

  async setups(): Promise<Setups> {
    return this.#json("GET", "setups");
  }

  /** The setup is the one that was chosen last; "": none is. */
  async useSetup(name: string): Promise<Setups> {
    return this.#json("POST", "setups", { name });
  }

  async keepSetup(name: string, tables: Tables, overwrite: boolean): Promise<Setups> {
    return this.#json("PUT", "setups", { name, tables, overwrite });
  }

  async dropSetup(name: string): Promise<Setups> {
    return this.#json("DELETE", "setups", { name });
  }

  async #json<T>(method: string, path: string, data?: unknown): Promise<T> {
    const body = data === undefined ? undefined : JSON.stringify(data);
    return (await (await this.#call(method, path, body)).json()) as T;
  }

  async #call(method: string, path: string, body?: BodyInit, more: RequestInit = {}): Promise<Response> {
    const headers = {
      Authorization: `Bearer ${this.#token}`,
      ...(typeof body === "string" ? { "Content-Type": "application/json" } : {}),
      ...more.headers,
    };
    let response: Response;
    try {
      response = await fetch(`api/${path}`, { ...more, method, headers, body });
    } catch (error) {
      if (more.signal?.aborted) throw error;
      throw new Gone(String(error));
    }
    if (response.ok) return response;
    throw await refusal(response);
  }
}

async function refusal(response: Response): Promise<Refusal> {
  const said = (await response.json().catch(() => ({}))) as { error?: Fault; state?: State; exists?: string[] };
  return new Refusal(
    response.status,
    said.error ?? { message: same(`${response.status} ${response.statusText}`) },
    said.state,
    said.exists ?? [],
  );
}

/** A text that is the same in both languages. */
export const same = (text: string): Said => [text, text];
