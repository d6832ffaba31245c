/** The question before a cut for which no wire was given: which one, or none on purpose. */
import { get } from "../dom.ts";
import { show } from "../message.ts";
import type { Desk } from "./desk.ts";
import { set } from "./edits.ts";
import { Field, type Value } from "./inputs.ts";
import type { TellTale } from "./told.ts";

/** Tells whether some contour is cut, or may be, with a distance from it. */
function hasDistance(desk: Desk): boolean {
  const { machine = {}, layer = [], contour = [] } = desk.edited.job;
  return Boolean(machine["wire"] || machine["offset"]) || [...layer, ...contour].some(({ offset }) => offset);
}

/** Asks once for a drawing; false: nothing is cut. A wire that is given is the job's. */
export async function asksForWire(desk: Desk, told: TellTale): Promise<boolean> {
  const isAllOpen = [...desk.contours.values()].every(({ closed }) => !closed);
  if (!desk.contours.size || isAllOpen || hasDistance(desk) || told.hasAccepted("on-the-line")) return true;
  const given: Record<string, Value> = {};
  const fields = (["wire", "gap"] as const).map((key) => {
    const plan = {
      key: `ask-${key}`,
      label: key,
      kind: "number",
      unit: "mm",
      example: key === "wire" ? "0.18" : "0.01",
    } as const;
    const field = new Field(plan, (value) => Object.assign(given, { [key]: value }), show, false);
    field.name();
    return field;
  });
  get("wire-fields").replaceChildren(...fields.map(({ row }) => row));
  const dialog = get<HTMLDialogElement>("which-wire");
  const answer = await new Promise<"cut" | "line" | "">((tell) => {
    const end = (how: "cut" | "line" | ""): void => {
      dialog.onclose = null;
      dialog.close();
      tell(how);
    };
    get("wire-cut").onclick = () => {
      // (what is still being typed is taken when the button has the caret)
      if (typeof given["wire"] === "number" && !dialog.querySelector("[aria-invalid=true]")) end("cut");
      else fields[0]?.focus();
    };
    get("wire-line").onclick = () => end("line");
    get("wire-no").onclick = () => end("");
    dialog.onkeydown = (event) => {
      if (event.key !== "Enter" || !(event.target instanceof HTMLInputElement)) return;
      event.preventDefault();
      event.target.blur();
      get("wire-cut").click();
    };
    dialog.onclose = () => tell("");
    dialog.showModal();
    fields[0]?.focus();
  });
  if (answer === "line") told.acceptAll("on-the-line");
  if (answer === "cut") {
    const after = set(desk.edited, "machine", "wire", given["wire"]);
    desk.edit(given["gap"] === undefined ? after : set(after, "machine", "gap", given["gap"]));
  }
  return answer !== "";
}
