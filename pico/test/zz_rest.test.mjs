// Examples typed at the prompt over USB: their tapes, byte for byte. PICO_ALL=1: all of them (half an hour).
import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import test from "node:test";
import { Board, part, tape } from "./board.mjs";
import { ROOT } from "./chip.mjs";

const FEW = ["xy-star", "plate-fillets", "cad-tape", "data-polygon"];
const all = readdirSync(new URL("examples", ROOT)).filter((name) => name.endsWith(".skg")).map((name) => name.slice(0, -4));
assert.ok(all.length > 50);
const names = all.slice(all.indexOf("fit-gear"));

test("examples", async (t) => {
  const board = new Board();
  for (const name of names) {
    await t.test(name, () => {
      board.type("NEW");
      board.program(part(name));
      board.host.punch.received = "";
      assert.doesNotMatch(board.type("RUN"), /ERR/);
      assert.equal(board.tape, tape(name));
    });
  }
});

test("an example of milling with the milling ROM", () => {
  const board = new Board({ rom: "MILL" });
  board.program(part("mill/plate"));
  assert.doesNotMatch(board.type("RUN"), /ERR/);
  assert.equal(board.tape, readFileSync(new URL("examples/mill/plate.nc", ROOT), "latin1"));
});
