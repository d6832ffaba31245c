/** Messages between the server and the page; lengths in mm, angles in radians. */

export type Point = readonly [number, number];
/** A sentence in English and in Chinese. */
export type Said = readonly [string, string];
/** A line `x0 y0 x1 y1`, an arc `x0 y0 x1 y1 cx cy sweep`, or a curve `"c" x0 y0 x1 y1 …`. */
export type Edge = readonly (number | "c")[];
/** One of a pair. */
export type Member = "punch" | "die";
export type Side = "auto" | "inside" | "outside" | "left" | "right" | "on";
export type Kind = "outline" | "opening" | "open";

/** The settings of a contour; absent ones are inherited. */
export interface Wanted {
  cut?: boolean;
  side?: Side;
  offset?: number;
  passes?: readonly number[];
  tab?: number;
  /** The tab of slugs; a contour by itself has `tab` alone. */
  slug_tab?: number;
  /** The number of tabs, or their places. */
  tabs?: number | readonly Point[];
  tab_passes?: readonly number[];
  overlap?: number;
  lead?: number;
  lead_shape?: "perpendicular" | "arc";
  reverse?: boolean;
  /** Between a punch and its die, on each side; which of both takes it. */
  clearance?: number;
  clearance_on?: Member;
  start?: Point;
  entry?: Point;
  order?: number;
}

export interface LayerWanted extends Wanted {
  name: string;
}

/** A contour that something is wanted of, and how it is found again. */
export interface Chosen extends Wanted {
  layer: string;
  kind: Kind;
  at: Point;
  size: Point;
}

export type Values = Readonly<Record<string, unknown>>;

export interface Job {
  readonly schema: number;
  readonly drawing: string;
  readonly sha256: string;
  readonly read?: Values;
  readonly machine?: Values;
  readonly place?: Values;
  readonly copies?: Values;
  readonly default?: Wanted;
  readonly tape?: Values;
  readonly price?: Values;
  readonly layer?: readonly LayerWanted[];
  readonly contour?: readonly Chosen[];
}

export interface Layer {
  readonly name: string;
  readonly contours: readonly number[];
  /** Entities on it that are not cut, and why. */
  readonly left: number;
  readonly why: Said;
}

export interface Contour {
  readonly id: number;
  readonly name: string;
  readonly layer: string;
  /** All that it is on. */
  readonly layers: readonly string[];
  readonly kind: Kind;
  readonly depth: number;
  readonly closed: boolean;
  readonly at: Point;
  readonly size: Point;
  readonly edges: readonly Edge[];
}

/** What is known of a line but its text: the contour and the place that it is about, the settings that it advises, with values. */
interface Facts {
  readonly code?: string;
  readonly contour?: number | null;
  readonly place?: Point | null;
  readonly advice?: readonly (readonly [string, string | null])[];
}

/** One line of a report; `care`: it wants a decision, and is known again by its `key`. */
export interface Line extends Facts {
  readonly text: Said;
  readonly care?: boolean;
  readonly key?: number;
}

export interface Fault extends Facts {
  readonly message: Said;
}

/** A contour as it would be cut. */
export interface Planned {
  readonly cut: boolean;
  readonly hole: Point | null;
  readonly entry: Point | null;
  /** The beginning of the tab before the entry. */
  readonly tab: Point | null;
  /** Of each tab its two ends, and the start holes beside these. */
  readonly tabs: readonly (readonly [Point, Point, Point, Point])[];
  readonly direction: number | null;
  readonly radius: number | null;
  readonly passes: readonly number[];
  readonly lead_arc: boolean;
  readonly number: number | null;
  readonly values: Wanted;
  readonly error?: Fault | null;
}

/** The part on the machine, in the places of the drawing: what is 0, 0 there, the ways of x and y; the matrices of copies. */
export interface Lying {
  readonly zero: Point | null;
  readonly axes: readonly [Point, Point];
  readonly copies: readonly Matrix[];
}

/** x goes to a·x + c·y + e, y to b·x + d·y + f. */
export type Matrix = readonly [number, number, number, number, number, number];

export interface Plan {
  readonly lying?: Lying;
  readonly order: readonly number[];
  readonly said: readonly Line[];
  readonly error?: Fault | null;
  readonly contours: Readonly<Record<string, Planned>>;
}

export interface Match {
  readonly chosen: number;
  readonly id: number | null;
  readonly moved: number;
  readonly confirm: boolean;
}

/** What is written on a drawing: its text, where it begins, and how high a letter is, and which way up, mm. */
export interface Note {
  readonly text: string;
  readonly place: Point;
  readonly up: Point;
}

/** A repair that may be asked for: a line between two ends, two ends to where they cross, a line that is left.
 * `places`: the ends; `asked`: what the job has then; `size`, mm. */
export interface Repair {
  readonly kind: "bridge" | "corner" | "stray";
  readonly places: readonly [Point, Point];
  readonly asked: readonly number[];
  readonly size: number;
}

/** What is not cut. */
export interface Left {
  readonly edges: readonly Edge[];
  readonly notes: readonly Note[];
}

export interface State {
  readonly rev: number;
  readonly name: string;
  readonly can_save: boolean;
  /** Job files beside the drawing that nobody has looked at: what was not saved, the drawing's own. */
  readonly offers?: readonly string[];
  readonly sha256: string;
  readonly size: Point;
  readonly low: Point;
  readonly units: string;
  readonly units_from: Said;
  readonly layers: readonly Layer[];
  readonly contours: readonly Contour[];
  readonly starts: readonly Point[];
  readonly left: Left;
  readonly repairs?: readonly Repair[];
  readonly report: readonly Line[];
  readonly job: Job;
  readonly matches: readonly Match[];
  readonly plan: Plan;
  readonly run?: number | null;
  readonly run_rev?: number | null;
  /** Rises when the contours are others. */
  readonly drawn?: number;
  /** The drawing cannot be read, or its file is gone. */
  readonly error?: Fault | null;
}

/** The answer to another job: with the drawing where it was read anew, else of the plan's contours those that have changed. */
export type Put = Partial<State> & Pick<State, "rev" | "job" | "matches" | "plan">;

/** A state without the drawing, which is the one that the page has. */
export type Later = Put & Pick<State, "name">;

/** Nothing is open. */
export interface Empty {
  readonly rev: number;
  readonly name: null;
}

export interface Result {
  readonly lines: readonly Line[];
  /** How near to the drawing, blocks, stops, length, time, area, price: as the report has them. */
  readonly figures: Said;
  readonly tape_name: string;
  /** The die of a punch: its own, but for the lines. */
  readonly mate?: Omit<Result, "lines" | "mate">;
  readonly start: Point;
  /** The way from the machine to the drawing: a matrix's rows, what goes to what, mm. */
  readonly back: readonly number[];
}

export interface Run {
  readonly state: "running" | "done" | "failed" | "cancelled";
  readonly k: number;
  readonly stage: "plan" | "board" | "check" | "write";
  readonly done: number;
  readonly of: number;
  readonly error?: Fault | null;
  readonly result?: Result | null;
}

/** Edges of the wire's centre by contour, for each pass and tab. */
export type Ways = Readonly<Record<string, readonly (readonly Edge[])[]>>;
export type FileKind = "tape" | "program" | "sheet" | "job" | "holes" | "drill";
/** The name of what is saved, without endings, "" for the drawing's; a short one's tape has eight letters and three. */
export interface Named {
  readonly name: string;
  readonly style: Style;
  readonly short: boolean;
}
export type Style = "punch" | "spaced" | "numbered" | "padded" | "joined";

/** Tables of a job: keys with their values. */
export type Tables = Readonly<Record<string, Values>>;
/** A setup that is kept, as a job has it; a damaged one has what is wrong with it. */
export interface Setup {
  readonly name: string;
  readonly tables?: Tables;
  readonly error?: Fault;
}
/** The setups, which was chosen last ("" for none), and the keys that one has, by table. */
export interface Setups {
  readonly setups: readonly Setup[];
  readonly last: string;
  readonly keys: Readonly<Record<string, readonly string[]>>;
}
