/** The drawing on the screen without a browser: changes of a job, geometry of contours, what is typed. */
import assert from "node:assert/strict";
import { test } from "node:test";
import { change, edited, forget, isCut, moved, own, reset, set } from "../src/ui/edits.ts";
import { edgesOf, lengthOfAll, nearest, placeAlong, shapeOf, trace } from "../src/ui/geometry.ts";
import { typed, typedList } from "../src/ui/look.ts";
import type { Contour, Edge, Job } from "../src/ui/types.ts";
import { visible } from "../src/ui/visible.ts";
import { w } from "../src/ui/words.ts";

const JOB: Job = { schema: 1, drawing: "part.dxf", sha256: "" };

const contour = (id: number, at: [number, number], edges: Edge[] = []): Contour => ({
  id,
  name: `contour ${id}`,
  layer: "PART",
  layers: ["PART", "SECOND"],
  kind: "opening",
  depth: 1,
  closed: true,
  at,
  size: [10, 10],
  edges,
});
const CONTOURS = new Map([0, 1, 2].map((id) => [id, contour(id, [20 * id, 0])]));

test("what is wanted of a contour is an entry of the job, and none when all is inherited again", () => {
  const empty = edited(JOB, []);
  const tabbed = change(empty, { contours: [1] }, { tab: 1.5 }, CONTOURS);
  assert.deepEqual(tabbed.job.contour, [{ tab: 1.5, layer: "PART", kind: "opening", at: [20, 0], size: [10, 10] }]);
  assert.deepEqual(tabbed.ids, [1]);
  const both = change(tabbed, { contours: [1, 2] }, { side: "on" }, CONTOURS);
  assert.deepEqual(both.ids, [1, 2]);
  assert.deepEqual(
    own(both, { contours: [2, 0] }).map(({ side }) => side),
    ["on", undefined],
  );
  const without = change(both, { contours: [1] }, { tab: undefined, side: undefined }, CONTOURS);
  assert.deepEqual(without.ids, [2]);
  assert.deepEqual(reset(both, { contours: [1, 2] }, CONTOURS).job.contour, []);
  assert.deepEqual(empty.ids, [], "the job before is as it was");
});

test("contour beats layer beats everything", () => {
  const all = change(edited(JOB, []), "all", { cut: false }, CONTOURS);
  const layer = change(all, { layer: "part" }, { cut: true }, CONTOURS);
  const one = change(layer, { contours: [2] }, { cut: false }, CONTOURS);
  assert.deepEqual(
    [0, 1, 2].map((id) => isCut(one, CONTOURS.get(id))),
    [true, true, false],
  );
  assert.deepEqual(
    [0, 1, 2].map((id) => isCut(all, CONTOURS.get(id))),
    [false, false, false],
  );
  assert.deepEqual(change(layer, { layer: "part" }, { cut: undefined }, CONTOURS).job.layer, []);
  const second = change(layer, { layer: "second" }, { cut: false }, CONTOURS);
  assert.ok(isCut(second, CONTOURS.get(0)), "the layer that comes first in the job");
});

test("a lost contour stays in the job until it is given up", () => {
  const job: Job = {
    ...JOB,
    contour: [
      { ...entry(0), tab: 1 },
      { ...entry(1), tab: 2 },
    ],
  };
  const found = edited(job, [
    { chosen: 0, id: null, moved: 0, confirm: false },
    { chosen: 1, id: 1, moved: 0, confirm: false },
  ]);
  assert.deepEqual(found.ids, [null, 1]);
  const changed = change(found, { contours: [1] }, { tab: undefined }, CONTOURS);
  assert.deepEqual(changed.ids, [null]);
  assert.deepEqual(forget(found, 0).ids, [1]);
  // a change that was made meanwhile is about the same contours, numbered anew
  const later = change(found, { contours: [2] }, { tab: 3 }, CONTOURS);
  const renumbered = [contour(7, [20, 0]), contour(8, [40, 0])];
  assert.deepEqual(moved(later, edited(job, []), renumbered).ids, [null, null, 8]);
  assert.deepEqual(moved(later, edited(job, [{ chosen: 1, id: 7, moved: 0, confirm: false }]), renumbered).ids, [null, 7, 8]);
});

function entry(id: number) {
  const { layer, kind, at, size } = CONTOURS.get(id) as Contour;
  return { layer, kind, at, size };
}

test("the machine's values: undefined is the usual one", () => {
  const wired = set(edited(JOB, []), "machine", "wire", 0.18);
  assert.deepEqual(wired.job.machine, { wire: 0.18 });
  assert.deepEqual(set(wired, "machine", "wire", undefined).job.machine, {});
});

test("lines, arcs and curves: lengths, the nearest place, the place so far along", () => {
  const half: Edge[] = [
    [0, 0, 10, 0],
    [10, 0, 10, 4, 10, 2, Math.PI],
    ["c", 10, 4, 5, 5, 0, 4],
    [0, 4, 0, 0],
  ];
  const shape = shapeOf(contour(0, [0, 0], half));
  const length = 10_000 + Math.PI * 2000 + 2 * Math.hypot(5000, 1000) + 4000;
  assert.ok(Math.abs(lengthOfAll(shape.edges) - length) < 1e-6);
  const right = nearest(shape, [13_000, 2000]);
  assert.ok(Math.hypot(right.place[0] - 12_000, right.place[1] - 2000) < 1e-6 && Math.abs(right.distance - 1000) < 1e-6);
  assert.ok(Math.abs(right.along - 10_000 - Math.PI * 1000) < 1e-6);
  assert.ok(Math.abs(Math.cos(right.way)) < 1e-9 && Math.sin(right.way) > 0);
  const [left, bottom, most, top] = shape.box;
  assert.ok(left === 0 && bottom === 0 && Math.abs(most - 12_000) < 4 && top === 5000);
  for (let along = 0; along < length; along += 777) {
    const back = nearest(shape, placeAlong(shape, along).place);
    assert.ok(back.distance < 1e-6 && Math.abs(back.along - along) < 1e-3, String(along));
  }
});

test("an arc is drawn as lines that leave it by less than a pixel, at any scale", () => {
  const [arc] = edgesOf([[5, 0, -5, 0, 0, 0, Math.PI]]);
  for (const scale of [1e-4, 0.01, 1]) {
    let [x0, y0] = [5000, 0];
    let worst = 0;
    trace(arc as readonly number[], scale, (x, y) => {
      worst = Math.max(worst, (5000 - Math.hypot((x + x0) / 2, (y + y0) / 2)) * scale);
      [x0, y0] = [x, y];
    });
    assert.ok(worst < 0.2 && Math.hypot(x0 + 5000, y0) < 1e-9, `${scale}: ${worst}`);
  }
});

test("numbers as people type them", () => {
  assert.deepEqual(["0.18", "0,18", " .5 ", "-3", "", "1e3", "a", "1.2.3"].map(typed), [
    0.18,
    0.18,
    0.5,
    -3,
    undefined,
    null,
    null,
    null,
  ]);
  assert.deepEqual(["０．２５", "０，２５", "－3", "−3", "–3"].map(typed), [0.25, 0.25, -3, -3, -3]);
  assert.deepEqual(typedList("0.06, 0.02, 0"), [0.06, 0.02, 0]);
  assert.deepEqual(typedList("0.06，0.02 0"), [0.06, 0.02, 0]);
  assert.equal(typedList(" "), undefined);
  assert.equal(typedList("0.06, x"), null);
});

test("a foreign name is shown, not obeyed, and takes nothing along that stands beside it", () => {
  assert.equal(
    visible("a\u001b[2K\u009b\u202eb\u2066\n\u200b\u2028\u2003"),
    "a\\x1b[2K\\x9b\\u202eb\\u2066\\x0a\\u200b\\u2028\\u2003",
  );
  for (const name of ["零件 \u3000 5", "Größe Ø\u00a03", "деталь", "C:\\parts\\a.dxf"]) assert.equal(visible(name), name);
  assert.equal(visible("قطعة"), "\u2068قطعة\u2069");
  assert.equal(w("ofLayer", "a\u202e"), "Layer a\\u202e");
});
