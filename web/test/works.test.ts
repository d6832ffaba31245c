import assert from "node:assert/strict";
import { test } from "node:test";
import { nameFor, originOf, stemOf } from "../src/identity.ts";
import { nameOf, titleOf, type Work, Works } from "../src/works.ts";

const program = (title: string, ...rows: string[]): string => [`10 REM ${title}`, ...rows, ""].join("\n");
const [A, B, C] = ["20 CUT O,(5,0)", "30 BACK", "40 END"];

function shelf(): { there: { works: Work[] }; titles: () => string[]; kept: Works } {
  const there = { works: [] as Work[] };
  const kept = new Works(
    there,
    (text) => text === program("EXAMPLE"),
    () => undefined,
  );
  return {
    there,
    titles: () => there.works.map(({ program: text }) => text.split("\n").slice(0, -1).join("|")),
    kept,
  };
}

test("a work has its entry while it is changed; another title, and a change of what was opened, have their own", () => {
  const { titles, kept } = shelf();
  kept.keep(program("ONE", A));
  kept.keep(program("ONE", A, B));
  assert.deepEqual(titles(), [`10 REM ONE|${A}|${B}`]);
  kept.keep(program("TWO", A, B));
  assert.deepEqual(titles(), [`10 REM TWO|${A}|${B}`, `10 REM ONE|${A}|${B}`]);
  // opened from the list, changed, changed again
  kept.begin();
  kept.keep(program("ONE", A, B));
  kept.keep(program("ONE", A, C));
  kept.keep(program("ONE", A, B, C));
  assert.deepEqual(titles(), [`10 REM ONE|${A}|${B}|${C}`, `10 REM ONE|${A}|${B}`, `10 REM TWO|${A}|${B}`]);
  // put back letter by letter to what is kept, and changed from there
  kept.keep(program("ONE", A, B));
  kept.keep(program("ONE", A, "35 I=1"));
  assert.equal(titles().length, 4);
  assert.ok(titles().includes(`10 REM ONE|${A}|${B}`));
  // a blank is a change
  kept.begin();
  kept.keep(program("TW O", A, B));
  assert.ok(titles().includes(`10 REM TW O|${A}|${B}`) && titles().includes(`10 REM TWO|${A}|${B}`));
});

test("typed line by line it is one work; a reload goes on with it; an example is none", () => {
  const { there, titles, kept } = shelf();
  kept.keep(`${A}\n`);
  kept.keep(`${A}\n${B}\n`);
  kept.keep(program("AT LAST", A, B));
  assert.deepEqual(titles(), [`10 REM AT LAST|${A}|${B}`]);
  const present = kept.present;
  assert.equal(present, there.works[0]?.id);
  kept.begin();
  kept.goOn(present, there.works[0]?.program ?? "");
  kept.keep(program("AT LAST", A, B, C));
  kept.keep(program("EXAMPLE"));
  kept.keep("");
  assert.deepEqual(titles(), [`10 REM AT LAST|${A}|${B}|${C}`]);
});

test("deleted comes back; works of a file come once, whatever their ids", () => {
  const { there, titles, kept } = shelf();
  kept.keep(program("ONE", A));
  const [one] = there.works as [Work];
  const undo = kept.delete(one.id);
  assert.deepEqual(titles(), []);
  kept.keep(program("ONE", A));
  assert.deepEqual(titles(), [], "it does not come back by itself");
  kept.begin();
  kept.goOn(kept.present, program("ONE", A));
  kept.keep(program("ONE", A));
  assert.deepEqual(titles(), [], "nor after a reload");
  undo();
  assert.deepEqual(kept.all, [one]);
  kept.add([one, { ...one, program: program("OTHER", A) }]);
  assert.equal(new Set(kept.all.map(({ id }) => id)).size, 2);
  assert.deepEqual(titles(), [`10 REM ONE|${A}`, `10 REM OTHER|${A}`]);
});

test("names: of the part, of the file while its title stays, of the first REM", () => {
  assert.equal(titleOf("5 I=1\n10 rem  Cam, 2nd try \n20 REM NO\n"), "Cam, 2nd try");
  assert.equal(titleOf("10 PRINT 1\n"), "");
  assert.equal(nameOf("10 PRINT 1\n"), "10 PRINT 1");
  assert.equal(stemOf("A wrench: hexagon hole, shaft, open jaw; wire inside"), "a-wrench-hexagon-hole-shaft-open-jaw");
  assert.deepEqual([stemOf("../../x"), stemOf("?!"), stemOf("Z".repeat(99)).length], ["x", "part", 40]);
  const origin = originOf("mine.skg", program("ONE", A));
  assert.equal(nameFor(program("ONE", B), undefined, origin).name, "mine");
  assert.equal(nameFor(program("TWO", B), undefined, origin).name, "two");
  assert.deepEqual(nameFor(program("ONE"), "wrench", origin), { name: "wrench", isPart: true });
});
