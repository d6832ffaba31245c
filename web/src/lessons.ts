/** Lessons: a file of steps, as a teacher writes it; and whether a tape is the one that a step wants.
 *
 * The file is Markdown. `# ` is the title of all, `## ` that of a step, with paragraphs below; words in backquotes are code. Of a
 * step's fences ```skg is the program to begin with, ```tape the tape that is wanted (any whole one without it), ```skg answer a
 * program that makes it. */
import { boxOf, distanceFrom, extentOf, type Layout, layOut, type Placed, placeAt } from "./placed.ts";
import { readTape, TapeError, type XY } from "./tape.ts";

export interface Step {
  title: string;
  paragraphs: string[];
  program: string;
  answer: string;
  tape: string;
}

export interface Lessons {
  title: string;
  paragraphs: string[];
  steps: Step[];
}

/** A file that is no lesson: its line, and what is wrong there. */
export class LessonError extends Error {
  constructor(
    readonly line: number,
    readonly why: "lessonStep" | "lessonFence" | "lessonKind" | "lessonTape",
  ) {
    super(`${line}: ${why}`);
  }
}

/** The fences of a step, by the words behind their backquotes. */
const KINDS: Record<string, keyof Step> = { skg: "program", "skg answer": "answer", tape: "tape" };

/** Reads a file of steps. */
export function readLessons(text: string): Lessons {
  const found: Lessons = { title: "", paragraphs: [], steps: [] };
  let step: Step | undefined;
  let fence: { kind: keyof Step | undefined; line: number; rows: string[] } | undefined;
  let paragraph: string[] = [];
  const flush = (): void => {
    if (paragraph.length) (step ?? found).paragraphs.push(paragraph.join(" "));
    paragraph = [];
  };
  for (const [at, row] of text.replace(/\r\n?/g, "\n").split("\n").entries()) {
    const opened = /^```(.*)$/.exec(row);
    if (fence) {
      if (!opened) {
        fence.rows.push(row);
        continue;
      }
      const body = fence.rows.map((each) => `${each}\n`).join("");
      if (step && fence.kind) Object.assign(step, { [fence.kind]: body });
      if (fence.kind === "tape") check(body, fence.line);
      fence = undefined;
    } else if (opened) {
      flush();
      const words = (opened[1] ?? "").trim();
      const kind = KINDS[words];
      // (another kind is the teacher's note: it is not shown)
      if (/^(skg|tape)\b/.test(words) && !(kind && step)) throw new LessonError(at + 1, "lessonKind");
      fence = { kind, line: at + 1, rows: [] };
    } else if (row.startsWith("## ")) {
      flush();
      step = { title: row.slice(3).trim(), paragraphs: [], program: "", answer: "", tape: "" };
      found.steps.push(step);
    } else if (row.startsWith("# ") && !found.title) {
      found.title = row.slice(2).trim();
    } else if (row.trim()) {
      paragraph.push(row.trim());
    } else {
      flush();
    }
  }
  flush();
  if (fence) throw new LessonError(fence.line, "lessonFence");
  if (!found.steps.length) throw new LessonError(1, "lessonStep");
  return found;
}

function check(tape: string, line: number): void {
  try {
    readTape(tape);
  } catch (error) {
    throw error instanceof TapeError ? new LessonError(line + error.line, "lessonTape") : error;
  }
}

/** Two paths are the same where they are nowhere farther from each other, µm. */
const NEAR = 5;
/** Places along a path that are looked at, this far apart at most, µm. */
const APART = 500;

/** The first difference of a tape's cut from the wanted one: a block that leaves it, or a place, µm, to which no block comes; nothing
 * where they are the same. Neither order nor direction nor start hole matters, nor where on the sheet it lies. */
export function differenceOf(layout: Layout, wanted: string): { block: number } | { missing: XY } | undefined {
  const cut = layout.blocks.filter(({ role }) => role === "cut");
  const goal = layOut(readTape(wanted).items).layout.blocks.filter(({ role }) => role === "cut");
  const [ours, theirs] = [extentOf(cut), extentOf(goal)];
  if (!ours || !theirs) return theirs ? { missing: goal[0]?.start ?? [0, 0] } : undefined;
  const shift: XY = [ours[0] - theirs[0], ours[1] - theirs[1]];
  for (const placed of cut) {
    if (!placesOf(placed).every(([x, y]) => isNear([x - shift[0], y - shift[1]], goal))) return { block: placed.number };
  }
  for (const placed of goal) {
    const gone = placesOf(placed).find(([x, y]) => !isNear([x + shift[0], y + shift[1]], cut));
    if (gone) return { missing: [gone[0] + shift[0], gone[1] + shift[1]] };
  }
  return undefined;
}

function placesOf(placed: Placed): XY[] {
  const parts = Math.max(2, Math.ceil(placed.length / APART));
  return Array.from({ length: parts + 1 }, (_, part) => placeAt(placed, part / parts));
}

const isNear = (place: XY, blocks: readonly Placed[]): boolean =>
  blocks.some((placed) => {
    const [left, bottom, right, top] = boxOf(placed);
    const isOut = place[0] < left - NEAR || place[0] > right + NEAR || place[1] < bottom - NEAR || place[1] > top + NEAR;
    return !isOut && distanceFrom(placed, place) <= NEAR;
  });
