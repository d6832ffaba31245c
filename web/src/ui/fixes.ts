/** What can be done about a line that wants a decision: a change of the job, or the field that decides it. */
import { get } from "../dom.ts";
import { view } from "../shell.ts";
import type { Desk } from "./desk.ts";
import { type Change, change, type Edited, isRepaired, repaired, set } from "./edits.ts";
import { shown, typed } from "./look.ts";
import type { Told } from "./told.ts";
import type { Point, Repair } from "./types.ts";
import { find, type Word, w } from "./words.ts";

export interface Fix {
  readonly label: string;
  /** A shorter label, for where it stands beside another button. */
  readonly name?: string;
  /** The places that it is about, which are ringed while it is pointed at. */
  readonly places?: readonly Point[];
  act(): void;
}

/** Settings that are of the whole drawing: in which part of the job, and what of its words is a number or a list. */
const READ: Record<string, "text" | "number" | "list"> = {
  units: "text",
  open: "text",
  tolerance: "number",
  "start-layer": "text",
  "fit-tolerance": "number",
  encoding: "text",
  layer: "list",
};
const MACHINE: Record<string, "text" | "number"> = {
  wire: "number",
  gap: "number",
  offset: "number",
  rom: "text",
  ram: "number",
  small: "text",
  into: "text",
};
/** Keys of the job that are called otherwise. */
const KEYS: Record<string, string> = { layer: "layers" };
/** Words for a setting with a value, `open=leave`, or with any, `units`. */
const LABELS: Record<string, Word> = {
  "open=cut": "fixOpenCut",
  "open=leave": "fixOpenLeave",
  "open=all": "fixOpenAll",
  tolerance: "fixTolerance",
  units: "fixUnits",
  encoding: "fixEncoding",
  layer: "fixLayer",
  "small=leave": "fixSmall",
  "into=cut": "fixInto",
  "rom=no-drift": "fixRom",
  "side=inside": "fixInside",
  "side=outside": "fixOutside",
};
/** Words of the fields that decide what no value is advised for. */
const FIELDS: Record<string, Word> = {
  units: "units",
  wire: "wire",
  gap: "gap",
  offset: "fixOffset",
  ram: "ram",
  thickness: "thickness",
  side: "side",
  passes: "passes",
  tab: "tab",
  "slug-tab": "slugTab",
  tabs: "tabs",
  "tab-passes": "tabPasses",
  overlap: "overlap",
  start: "start",
};

/** Units that drawings without any are in, mostly. */
const USUAL = ["mm", "inch"];

/** Lines of the report about ends that do not meet. */
const OF_ENDS = new Set([
  "open-refused",
  "open-end",
  "outline-lost",
  "no-outline-gap",
  "no-outline-junctions",
  "ends-near",
  "open-on-line",
]);
/** Lines of the report about lines that are not cut. */
const OF_LINES = new Set(["line-around", "lines-between"]);
/** Repairs, in the order of their buttons, with these' words for one and for all. */
const KINDS: readonly (readonly [Repair["kind"], Word, Word | undefined])[] = [
  ["corner", "fixCorner", "fixCornerAll"],
  ["bridge", "fixBridge", "fixBridgeAll"],
  ["stray", "fixStray", undefined],
];
/** An end that a line of the report tells of is no farther from its place, mm. */
const NEAR = 0.01;

const under = (setting: string): string => KEYS[setting] ?? setting.replaceAll("-", "_");

export function fixesOf(desk: Desk, line: Told): Fix[] {
  const { code, contour, wrong, advice = [] } = line;
  const id = contour ?? undefined;
  const edit = (after: Edited): void => desk.edit(after);
  const wish = (wanted: Change): void =>
    edit(change(desk.edited, id === undefined ? "all" : { contours: [id] }, wanted, desk.contours));
  const inUnits = (units: string): Fix => ({
    label: w("fixUnits", find(units) ?? units),
    act: () => edit(set(desk.edited, "read", "units", units)),
  });
  const fixes: Fix[] = advice.flatMap(([setting, value]): Fix[] => {
    if (value === null) {
      // (what is read in a unit already is left as it is)
      const units = setting === "units" ? USUAL.filter((each) => wrong || each !== desk.state?.units) : [];
      return [...units.map(inUnits), ...fieldOf(desk, setting, id)];
    }
    const label = labelOf(setting, value);
    const part = setting in READ ? "read" : setting in MACHINE ? "machine" : undefined;
    const kind = READ[setting] ?? MACHINE[setting];
    const taken = kind === "number" ? typed(value) : kind === "list" ? [value] : value;
    if (part) return [{ label, act: () => edit(set(desk.edited, part, under(setting), taken)) }];
    return setting === "side" ? [{ label, act: () => wish({ side: value as Change["side"] }) }] : [];
  });
  if (code !== undefined && OF_ENDS.has(code)) fixes.unshift(...repairs(desk, line, KINDS));
  if (code !== undefined && OF_LINES.has(code)) fixes.unshift(...repairs(desk, line, KINDS.slice(-1)));
  if (id === undefined || !desk.contours.has(id)) return fixes;
  if (code === "thin-wall") fixes.push(...fieldOf(desk, "offset", id));
  else if (!wrong) return fixes;
  const isOfRoom = advice.some(([setting]) => setting === "offset" || setting === "small" || setting === "into");
  if (isOfRoom) fixes.push({ label: w("fixOnLine"), act: () => wish({ side: "on" }) });
  return [...fixes, { label: w("fixLeave"), act: () => wish({ cut: false }) }];
}

/** The repairs that close the outline at the place of a line of the report, and at all places like it; none for other lines. */
function repairs(desk: Desk, { place }: Told, kinds: typeof KINDS): Fix[] {
  const known = (desk.state?.repairs ?? []).filter((repair) => !isRepaired(desk.edited, repair));
  const far = ({ places }: Repair): number =>
    place ? Math.min(...places.map(([x, y]) => Math.hypot(x - place[0], y - place[1]))) : 0;
  const fixes: Fix[] = [];
  for (const [kind, one, all] of kinds) {
    const alike = known.filter((repair) => repair.kind === kind);
    const [nearest] = [...alike].sort((some, other) => far(some) - far(other));
    if (!nearest) continue;
    const fix = (label: string, some: readonly Repair[]): Fix => ({
      label,
      places: some.flatMap(({ places }) => places),
      act: () => desk.edit(repaired(desk.edited, some)),
    });
    // (a line is left that is at this place)
    if (kind !== "stray" || far(nearest) < NEAR) fixes.push(fix(w(one, shown(nearest.size)), [nearest]));
    if (all && alike.length > 1) fixes.push({ ...fix(w("fixAll", alike.length), alike), name: w(all, alike.length) });
  }
  return fixes;
}

function labelOf(setting: string, value: string): string {
  const word = LABELS[`${setting}=${value}`] ?? LABELS[setting];
  return word ? w(word, (setting === "units" && find(value)) || value) : `${find(FIELDS[setting] ?? "") ?? setting}: ${value}`;
}

/** A field gets the caret, for the contour that is meant or for all. */
function fieldOf(desk: Desk, setting: string, id: number | undefined): Fix[] {
  const word = FIELDS[setting];
  if (!word || id === undefined) return word ? [{ label: w("fixField", w(word)), act: () => focus(setting) }] : [];
  return [
    {
      label: w("fixField", w(word)),
      act: () => {
        desk.choose({ contours: [id] });
        focus(setting);
      },
    },
  ];
}

function focus(setting: string): void {
  const ids = [`#field-${under(setting)}`, `#field-${under(setting)}-x`];
  const found = [...document.querySelectorAll<HTMLElement>(ids.join(", "))];
  view("values");
  const field = found.find((each) => each.checkVisibility()) ?? found[0];
  if (field && get("more").contains(field)) get<HTMLDetailsElement>("more").open = true;
  field?.focus();
}
