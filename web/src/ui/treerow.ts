/** Rows of the tree: a layer, a contour. */
import { make } from "../dom.ts";
import { inPresent } from "../language.ts";
import type { Desk } from "./desk.ts";
import { isCut, own } from "./edits.ts";
import { shown } from "./look.ts";
import type { Contour, Kind, Layer } from "./types.ts";
import { visible } from "./visible.ts";
import { w } from "./words.ts";

const GLYPHS = { outline: "▢", opening: "◯", open: "∿" } as const;

export const kindWord = (kind: Kind): string => w(kind === "open" ? "openLine" : kind);

/** The name of a contour. */
export const titleOf = (contour: Contour): string => `${kindWord(contour.kind)} ${contour.size.map(shown).join(" × ")}`;

/** Writes a layer into its row. */
export function layerRow(element: HTMLElement, desk: Desk, layer: Layer, isFolded: boolean): void {
  const { scope, edited } = desk;
  element.ariaLevel = "1";
  if (layer.contours.length) {
    const cut = layer.contours.map((id) => isCut(edited, desk.contours.get(id)));
    element.ariaChecked = cut.every(Boolean) ? "true" : cut.some(Boolean) ? "mixed" : "false";
    element.ariaExpanded = String(!isFolded);
    element.append(make("span", "fold", isFolded ? "▸" : "▾"), make("span", "check"));
  } else {
    element.append(make("span", "fold"), make("span", "nocheck"));
    element.ariaDisabled = "true";
  }
  element.ariaSelected = String(typeof scope === "object" && "layer" in scope && scope.layer === layer.name);
  element.append(make("b", "", visible(layer.name)));
  const [wanted] = own(edited, { layer: layer.name });
  if (wanted?.offset !== undefined) element.append(make("span", "own", `R ${shown(wanted.offset)}`));
  if (!layer.left) return;
  const why = inPresent(layer.why);
  const left = make("span", "left", why ? w("left", layer.left, why) : w("leftOnly", layer.left));
  left.title = left.textContent ?? "";
  element.append(left);
}

/** Writes contours that are alike into their row. */
export function alikeRow(element: HTMLElement, desk: Desk, contours: readonly Contour[], isFolded: boolean): void {
  const { edited, chosen } = desk;
  const [first] = contours;
  if (!first) return;
  const cut = contours.map((each) => isCut(edited, each));
  element.ariaLevel = "2";
  element.ariaChecked = cut.every(Boolean) ? "true" : cut.some(Boolean) ? "mixed" : "false";
  element.ariaExpanded = String(!isFolded);
  element.ariaSelected = String(contours.some(({ id }) => chosen.includes(id)));
  const glyph = make("span", "glyph", GLYPHS[first.kind]);
  glyph.ariaHidden = "true";
  element.append(make("span", "fold", isFolded ? "▸" : "▾"), make("span", "check"), glyph);
  element.append(make("span", "title", titleOf(first)), make("b", "times", w("times", contours.length)));
  const errors = contours.flatMap(({ id }) => desk.planned(id)?.error ?? []);
  if (errors[0]) element.append(faultOf(inPresent(errors[0].message)));
}

/** Writes a contour into its row; `isWithin`: below that of all that are alike. */
export function contourRow(element: HTMLElement, desk: Desk, contour: Contour, isWithin: boolean): void {
  element.classList.toggle("within", isWithin);
  const { edited } = desk;
  const planned = desk.planned(contour.id);
  const cut = isCut(edited, contour);
  const [wanted = {}] = own(edited, { contours: [contour.id] });
  element.ariaLevel = isWithin ? "3" : "2";
  element.ariaChecked = String(cut);
  element.ariaSelected = String(desk.chosen.includes(contour.id));
  element.draggable = cut;
  element.dataset["id"] = String(contour.id);
  const number = make("span", "order", cut && planned?.number ? String(planned.number) : "–");
  const glyph = make("span", "glyph", GLYPHS[contour.kind]);
  glyph.ariaHidden = "true";
  element.append(number, make("span", "check"), glyph, make("span", "title", titleOf(contour)));
  if (wanted.offset !== undefined) element.append(make("span", "own", `R ${shown(wanted.offset)}`));
  if (planned?.error) element.append(faultOf(inPresent(planned.error.message)));
}

function faultOf(message: string): HTMLElement {
  const fault = make("span", "fault", "⚠");
  fault.title = message;
  fault.ariaLabel = message;
  fault.role = "img";
  return fault;
}
