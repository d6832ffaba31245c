/** What can be done about a line that wants a decision: a change of the job, or the field that decides it. */
import { get } from "../dom.ts";
import { view } from "../shell.ts";
import type { Desk } from "./desk.ts";
import { bridged, type Change, change, type Edited, set } from "./edits.ts";
import { shown, typed } from "./look.ts";
import type { Told } from "./told.ts";
import type { Gap } from "./types.ts";
import { find, type Word, w } from "./words.ts";

export interface Fix {
  readonly label: string;
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
  side: "side",
  passes: "passes",
  tab: "tab",
  "slug-tab": "slugTab",
  tabs: "tabs",
  "tab-passes": "tabPasses",
  overlap: "overlap",
  start: "start",
};

/** Lines of the report about ends that do not meet. */
const OF_ENDS = new Set(["open-refused", "open-end", "outline-lost", "no-outline-gap", "ends-near", "open-on-line"]);

const under = (setting: string): string => KEYS[setting] ?? setting.replaceAll("-", "_");

export function fixesOf(desk: Desk, line: Told): Fix[] {
  const { code, contour, wrong, advice = [] } = line;
  const id = contour ?? undefined;
  const edit = (after: Edited): void => desk.edit(after);
  const wish = (wanted: Change): void =>
    edit(change(desk.edited, id === undefined ? "all" : { contours: [id] }, wanted, desk.contours));
  const fixes: Fix[] = advice.flatMap(([setting, value]): Fix[] => {
    if (value === null) return fieldOf(desk, setting, id);
    const label = labelOf(setting, value);
    const part = setting in READ ? "read" : setting in MACHINE ? "machine" : undefined;
    const kind = READ[setting] ?? MACHINE[setting];
    const taken = kind === "number" ? typed(value) : kind === "list" ? [value] : value;
    if (part) return [{ label, act: () => edit(set(desk.edited, part, under(setting), taken)) }];
    return setting === "side" ? [{ label, act: () => wish({ side: value as Change["side"] }) }] : [];
  });
  if (code !== undefined && OF_ENDS.has(code)) fixes.unshift(...bridges(desk, line));
  if (!wrong || id === undefined || !desk.contours.has(id)) return fixes;
  const isOfRoom = advice.some(([setting]) => setting === "offset" || setting === "small" || setting === "into");
  if (isOfRoom) fixes.push({ label: w("fixOnLine"), act: () => wish({ side: "on" }) });
  return [...fixes, { label: w("fixLeave"), act: () => wish({ cut: false }) }];
}

/** A line is put in between two ends, those nearest to where the line of the report is, or between all. */
function bridges(desk: Desk, { place }: Told): Fix[] {
  const gaps = desk.state?.gaps ?? [];
  const far = ([x, y, u, v]: Gap): number =>
    place ? Math.min(Math.hypot(x - place[0], y - place[1]), Math.hypot(u - place[0], v - place[1])) : 0;
  const [nearest] = [...gaps].sort((one, other) => far(one) - far(other));
  if (!nearest) return [];
  const bridge = (some: readonly Gap[]): void => desk.edit(bridged(desk.edited, some));
  const wide = shown(Math.hypot(nearest[2] - nearest[0], nearest[3] - nearest[1]));
  const one = { label: w("fixBridge", wide), act: () => bridge([nearest]) };
  return gaps.length > 1 ? [one, { label: w("fixBridgeAll", gaps.length), act: () => bridge(gaps) }] : [one];
}

function labelOf(setting: string, value: string): string {
  const word = LABELS[`${setting}=${value}`] ?? LABELS[setting];
  return word ? w(word, value) : `${find(FIELDS[setting] ?? "") ?? setting}: ${value}`;
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
