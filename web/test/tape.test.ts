import assert from "node:assert/strict";
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { test } from "node:test";
import { dxfText } from "../src/dxf.ts";
import { isoText } from "../src/iso.ts";
import { boxOf, distanceFrom, layOut, placeAt } from "../src/placed.ts";
import { svgText } from "../src/svg.ts";
import { readBlock, readTape, TapeError, tapeText } from "../src/tape.ts";
import { Walk } from "../src/walk.ts";

/** Results of the tools in Python for the same tapes; tests/web/test_page.py writes them. */
interface Golden {
  tape: string;
  iso: string;
  ends: [number, number][];
  sweeps: number[];
  roles: string[];
  offPath: number;
  simulated: { steps: number; really: [number, number]; gap: [number, number] }[];
}

const FOLDER = process.env["PAGE_TEST"] as string;
const GOLDEN = JSON.parse(readFileSync(`${FOLDER}/golden.json`, "utf8")) as Record<string, Golden>;
const MODULE = new WebAssembly.Module(readFileSync("web/wasm/walk.wasm"));

test("tapes are laid out, walked and written as by the tools in Python", () => {
  assert.ok(Object.keys(GOLDEN).length > 50);
  for (const [name, golden] of Object.entries(GOLDEN)) {
    const { items, isForeign, hasNoEnd } = readTape(golden.tape);
    assert.deepEqual([isForeign, hasNoEnd, tapeText(items)], [false, false, golden.tape], name);
    const { layout } = layOut(items);
    assert.deepEqual(
      layout.blocks.map(({ end }) => [...end]),
      golden.ends,
      name,
    );
    for (const [at, { sweep }] of layout.blocks.entries()) {
      assert.ok(Math.abs(sweep - (golden.sweeps[at] as number)) < 1e-9, `${name} ${at}`);
    }
    assert.deepEqual(
      layout.blocks.map(({ role }) => role),
      golden.roles,
      name,
    );
    assert.equal(isoText(layout), golden.iso, name);
    writeFileSync(`${FOLDER}/${name}.dxf`, dxfText(layout));
    const walk = new Walk(MODULE);
    walk.begin(layout.blocks);
    while (!walk.measure(10_000));
    assert.deepEqual(
      walk.walked.map(({ steps, from, to }) => ({ steps, really: [to[0] - from[0], to[1] - from[1]] })),
      golden.simulated.map(({ steps, really }) => ({ steps, really })),
      name,
    );
    const offPath = Math.max(0, ...walk.walked.map((one) => one.offPath));
    assert.ok(Math.abs(offPath - golden.offPath) < 1e-9, name);
    const last = golden.simulated.at(-1)?.gap;
    const gap = walk.closing(layout.routes);
    assert.equal(Math.max(...(gap ?? [0, 0]).map(Math.abs)), Math.max(...(last ?? [0, 0]).map(Math.abs)), name);
  }
});

test("the walk can be scrubbed: every place is that of a walk without a stop", () => {
  const { layout } = layOut(readTape(readFileSync("examples/wrench.3b", "latin1")).items);
  const [there, back] = [new Walk(MODULE), new Walk(MODULE)];
  for (const walk of [there, back]) {
    walk.begin(layout.blocks);
    assert.ok(walk.measure(1e9));
  }
  const steps = Array.from({ length: 200 }, (_, at) => Math.floor((there.steps * at) / 199));
  const places = steps.map((step) => there.locate(step));
  assert.deepEqual(
    [...steps].reverse().map((step) => back.locate(step)),
    [...places].reverse(),
  );
  // (a block's end may lie a little past what the whole line or circle is measured by)
  const most = (GOLDEN["wrench"]?.offPath ?? 0) + 1;
  assert.ok(
    places.every((one) => one && one.off <= most),
    "no farther from the contour than skg sim has it",
  );
  assert.deepEqual(places.at(-1)?.place, there.walked.at(-1)?.to);
});

test("foreign forms of the same tape", () => {
  const plain = "B9900B0B9900GXL3\r\nB0B70100B70100GYL2\r\nB50100B100B100000GYNR1\r\nD\r\nB2B2B2GYL1\r\nDD\r\n";
  const { items } = readTape(plain);
  for (const [form, hasNoEnd] of [
    ["B9900 B0 B9900 GX L3 B0 B70100 B70100 GY L2 B50100 B100 B100000 GY NR1 D B2 B2 B2 GY L1 DD", false],
    ["b9900b0b9900gxl3b0b70100b70100gyl2b50100b100b100000gynr1db2b2b2gyl1dd", false],
    ["B9900BB9900GXL3\nBB70100B70100GYL2\nB50100B100B100000GYNR1\nD\nB2B2B2GYL1\n", true],
    [
      "N   1: B   9900 B      0 B   9900 GX L3 ;  -9.900, 0.000\nN 2: B 0 B 70100 B 70100 GY L2\n" +
        "N 3: B 50100 B 100 B 100000 GY NR1 (arc)\nD\nN 4: B 2 B 2 B 2 GY L1\nDD",
      false,
    ],
    ["\0\0\0B009900B0B09900GXL3\rB0B70100B70100GYL2\rB50100B100B100000GYNR1\rD\rB2B2B2GYL1\rDD\r\0\0", false],
    ["0001 B9900B0B9900GXL3\n0002 B0B70100B70100GYL2\n0003 B50100B100B100000GYNR1\nD\n0004 B2B2B2GYL1\nE", false],
  ] as const) {
    const read = readTape(form);
    assert.deepEqual(read.items, items, form);
    assert.equal(read.isForeign, true, form);
    assert.equal(read.hasNoEnd, hasNoEnd, form);
  }
  assert.deepEqual(readTape("\0\0" + plain), { items, isForeign: false, hasNoEnd: false });
});

test("what is no tape is refused where it is wrong", () => {
  for (const [text, block, line, column] of [
    ["", 1, 1, 1],
    ["hello", 1, 1, 1],
    ["B1B2B2GYL1\nB1B2B2GZL1", 2, 2, 1],
    ["B1B2B2GYL1 X", 2, 1, 12],
    ["B1B2B2GYL1\nDD\nB1B2B2GYL1", 2, 3, 1],
    ["B123456789B0B1GXL1", 1, 1, 1],
    ["B5B5B4GYL1", 1, 1, 1],
    ["B1B1B9GXNR1", 1, 1, 1],
    ["B0B0B0GXL1", 1, 1, 1],
    ["B10B0B10GXL2", 1, 1, 1],
    ["D", 1, 1, 2],
    ["B1B2B2GYL1DDD", 2, 1, 11],
  ] as const) {
    assert.throws(
      () => readTape(text),
      (error) => {
        assert.ok(error instanceof TapeError, text);
        assert.deepEqual([error.block, error.line, error.column], [block, line, column], text);
        return true;
      },
    );
  }
  assert.equal(readBlock("B1B2B2GYL1 "), undefined);
  assert.equal(readBlock("DD"), undefined);
});

test("places, distances and boxes of a block", () => {
  const [quarter] = layOut(readTape("B1000B0B1000GXNR1DD").items, [1000, 0]).layout.blocks;
  assert.ok(quarter);
  assert.deepEqual(quarter.end, [0, 1000]);
  assert.ok(Math.abs(quarter.length - 500 * Math.PI) < 1e-6);
  const middle = placeAt(quarter, 0.5);
  assert.ok(Math.abs(Math.hypot(...middle) - 1000) < 1e-9);
  assert.ok(distanceFrom(quarter, middle) < 1e-9);
  assert.equal(distanceFrom(quarter, [0, 0]), 1000);
  assert.equal(distanceFrom(quarter, [1000, -500]), 500);
  const [half] = layOut(readTape("B1000B0B2000GYNR1DD").items, [1000, 0]).layout.blocks;
  assert.deepEqual(boxOf(half as NonNullable<typeof half>).map(Math.round), [-1000, 0, 1000, 1000]);
});

test("a picture in SVG is to scale, and has no foreign signs in it", () => {
  const { items } = readTape(readFileSync("examples/recut.3b", "latin1"));
  const text = svgText(layOut(items).layout, 0.2, "<b>&");
  assert.match(text, /width="[\d.]+mm"/);
  assert.match(text, /id="kerf"[^>]*stroke-width="0.2"/);
  assert.ok(!text.includes("<b>"));
  assert.equal(svgText(layOut([]).layout, 0.2, ""), "");
});

test("all tapes of the examples are here", () => {
  const tapes = readdirSync("examples")
    .filter((file) => file.endsWith(".3b"))
    .map((file) => file.slice(0, -3));
  assert.deepEqual(Object.keys(GOLDEN).sort(), tapes.sort());
});
