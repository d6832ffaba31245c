// Memory that survives power off: always a whole program, the newest one that was finished.
import assert from "node:assert/strict";
import test from "node:test";
import { Board, part, tape } from "./board.mjs";
import { PowerCut } from "./chip.mjs";

/** The board as it is after the power has gone and come back; its paper when it is opened. */
const again = (board) => new Board({ flash: board.chip.flash });

test("a program, its variables and the settings come back; it runs", () => {
  const board = new Board({ feed: 700 });
  board.program(part("xy-star"));
  board.type("D=42.5");
  const { listing } = board;
  board.rest();
  const later = again(board);
  assert.match(later.paper, /\r\nSKG KEPT\r\n>$/);
  assert.equal(later.type("PRINT D"), "42.5\r\n");
  assert.deepEqual(later.listing, listing);
  assert.equal(later.type("#"), "#FEED 700\r\n#ROM SKG\r\n");
  later.type("RUN");
  assert.equal(later.tape, tape("xy-star"));
});

test("the flash is not written while somebody types, nor twice for the same", () => {
  const board = new Board();
  board.rest();
  const before = board.chip.writes;
  for (let i = 1; i <= 20; i++) board.type(`${i} REM LINE ${i}`);
  assert.equal(board.chip.writes, before);
  board.rest();
  const once = board.chip.writes;
  assert.ok(once > before && once - before < 30, `${once - before}`);
  board.rest();
  assert.equal(board.chip.writes, once);
});

test("power goes at each write in turn: the program before it, or the new one, never half of one", () => {
  const board = new Board();
  board.program("10 REM ONE\n20 REM ONE\n");
  board.rest();
  const flash = board.chip.flash.slice();
  let writes = 0;
  for (let cut = 1; ; cut++) {
    const later = new Board({ flash: flash.slice() });
    for (const line of ["10 REM TWO", "20 REM TWO", "30 REM TWO"]) later.type(line);
    later.chip.cutAt = later.chip.writes + cut;
    let wasCut = false;
    try {
      later.rest();
    } catch (error) {
      assert.ok(error instanceof PowerCut);
      wasCut = true;
    }
    const last = again(later);
    if (!wasCut) {
      assert.match(last.paper, /\r\nSKG KEPT\r\n>$/);
      assert.deepEqual(last.listing, ["10 REM TWO", "20 REM TWO", "30 REM TWO"]);
      break;
    }
    writes++;
    assert.match(last.paper, /\r\nSKG KEPT, WITHOUT THE LAST CHANGE\r\n>$/);
    assert.deepEqual(last.listing, ["10 REM ONE", "20 REM ONE"]);
  }
  assert.ok(writes > 5, `${writes}`);
});

test("each ROM has its own program; the panel's mistakes", () => {
  const board = new Board();
  board.type("10 REM SKG");
  const from = board.paper.length;
  board.type("#rom drive");
  assert.match(board.paper.slice(from), /\r\nSKG \d+\r\n>$/);
  board.type("10 REM DRIVE");
  board.type("#ROM SKG");
  assert.deepEqual(board.listing, ["10 REM SKG"]);
  board.type("#ROM DRIVE");
  assert.deepEqual(board.listing, ["10 REM DRIVE"]);
  for (const wrong of ["#FEED", "#FEED 50001", "#FEED 1X", "#FEED PINS", "#ROM", "#ROM SKGX", "#FEED 99999999999999", "#X"]) {
    assert.match(board.type(wrong), /^# FEED 0 TO 50000/, wrong);
  }
  assert.equal(board.type("#ROX\x7f\x7fOM DRIVEE\b\b "), "# FEED 0 TO 50000, FEED PIN, ROM SKG, ROM DRIVE, ROM MILL\r\n");
  assert.match(board.type("PRINT #"), /ERR 01/, "elsewhere it is the ROM's");
  const last = again(board);
  assert.equal(last.type("#"), "#FEED 0\r\n#ROM DRIVE\r\n");
});

test("a program of another version of the ROM is not loaded, and that is said", () => {
  const board = new Board();
  board.type("10 REM");
  board.rest();
  const { flash } = board.chip;
  const at = Buffer.from(flash).indexOf("SKG\xa0", "latin1");
  assert.ok(at > 0 && at < 0x20000);
  for (let i = at; (i = Buffer.from(flash).indexOf("SKG\xa0", i, "latin1")) > 0; ) flash[i + 2] = 0x48; // H
  const later = again(board);
  assert.match(later.paper, /THE KEPT PROGRAM IS OF ANOTHER VERSION: NOT LOADED\r\n\r\nSKH/);
  assert.deepEqual(later.listing, []);
});
