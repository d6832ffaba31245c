// The two lines: pastes, keys at once, break and BOOTSEL, a host that resets, sleeps, or does not read, garbage.
import assert from "node:assert/strict";
import test from "node:test";
import { Board, linesOf, part, tape } from "./board.mjs";

const ENDLESS = ["10 CUT (0,0)", "20 I=I+1", "30 CUT (I,I/3),(0,I)", "40 GOTO 20", "5 I=0"];
const CTRL_C = "\x03", CTRL_Z = "\x1a";

for (const [what, end] of [["CR", "\r"], ["CR LF", "\r\n"], ["LF", "\n"]]) {
  test(`a program and RUN pasted at once, lines that end with ${what}`, () => {
    const board = new Board();
    const from = board.paper.length;
    board.host.send(board.host.tty, part("cad-tape").replaceAll(/\r?\n/g, end) + "RUN" + end);
    assert.ok(board.chip.run(12000, () => /\nDD\r\n>$/.test(board.paper)), board.paper.slice(-300));
    assert.doesNotMatch(board.paper.slice(from), /ERR|\?/);
    assert.equal(board.tape, tape("cad-tape"));
  });
}

test("LOAD from the second line, SAVE to it; the reader's two seconds", () => {
  const board = new Board();
  const program = part("xy-star");
  board.host.send(board.host.punch, program + CTRL_Z);
  assert.doesNotMatch(board.type("LOAD"), /ERR/);
  const listed = board.listing;
  board.type("SAVE");
  assert.deepEqual(linesOf(board.tape.replaceAll("\0", "").replace(CTRL_Z, "")), listed);
  const saved = board.tape;
  board.type("NEW");
  board.host.send(board.host.punch, saved);
  board.type("LOAD");
  assert.deepEqual(board.listing, listed);
  const from = board.paper.length;
  board.host.send(board.host.punch, "900 PRI");
  const began = board.chip.nanos;
  board.host.send(board.host.tty, "LOAD\r");
  board.prompt(from);
  assert.match(board.paper.slice(from), /ERR 10/, "a torn tape");
  const seconds = (board.chip.nanos - began) / 1e9;
  assert.ok(1.5 < seconds && seconds < 3, `${seconds}`);
});

test("ctrl-C at once, with text typed ahead, which goes", () => {
  const board = new Board();
  for (const line of ENDLESS) board.type(line);
  const from = board.paper.length;
  board.host.send(board.host.tty, "RUN\rPRINT 7\rPRINT 8\r");
  assert.ok(board.chip.run(5000, () => board.tape.split("\n").length > 2));
  board.host.send(board.host.tty, `PRINT 9\r${CTRL_C}`);
  const began = board.chip.nanos;
  board.prompt(from);
  assert.ok(board.chip.nanos - began < 0.5e9);
  assert.match(board.paper, /ERR 10 LINE \d+\r\n>$/);
  assert.ok(!board.chip.run(50, () => !board.paper.endsWith(">")));
  assert.match(board.tape, /\r\nD\r\n$/);
  // ctrl-S and ctrl-Q
  const start = board.paper.length;
  board.host.send(board.host.tty, "LIST\r");
  assert.ok(board.chip.run(100, () => board.paper.length > start + 10));
  board.host.send(board.host.tty, "\x13");
  board.chip.run(5);
  const held = board.paper.length;
  board.chip.run(50);
  assert.equal(board.paper.length, held, "ctrl-S");
  board.host.send(board.host.tty, "\x11");
  board.prompt(held);
  assert.match(board.paper.slice(start), /\n40 GOTO 20\r\n>$/);
});

test("a break and BOOTSEL are the reset button: the program stays", () => {
  const board = new Board();
  for (const line of ENDLESS) board.type(line);
  const { listing } = board;
  for (const press of ["break", "bootsel"]) {
    board.host.send(board.host.tty, "RUN\r");
    board.chip.run(100);
    const from = board.paper.length;
    if (press === "break") board.host.break();
    else {
      board.chip.bootsel = true;
      assert.ok(!board.chip.wait(800, () => /SKG/.test(board.paper.slice(from))), "not yet");
      board.chip.wait(400, () => /SKG/.test(board.paper.slice(from)));
      board.chip.bootsel = false;
    }
    board.prompt(from);
    assert.match(board.paper.slice(from), /\r\nSKG \d+\r\n>$/);
    assert.deepEqual(board.listing, listing);
  }
});

test("the host resets the bus in the middle of a paste", () => {
  const board = new Board();
  board.program(part("xy-star"));
  board.host.send(board.host.tty, "RUN\r");
  assert.ok(board.chip.run(1000, () => /0002 B\d+$/.test(board.paper)));
  board.host.reset();
  board.host.punch.open = board.host.tty.open = false;
  const seen = board.paper.length;
  board.host.connect();
  board.host.open(board.host.tty);
  board.prompt(seen);
  const shown = board.paper.match(/^\d{4} B.*$/gm).map((line) => line.trim().slice(5));
  const wanted = linesOf(tape("xy-star")).filter((line) => line.startsWith("B"));
  assert.deepEqual(shown, wanted, "no block of the paper is lost or doubled");
});

test("the host sleeps: a run goes on, and what is printed waits", () => {
  const board = new Board({ punch: false });
  board.program(part("xy-star"));
  board.host.send(board.host.tty, "RUN\r");
  board.chip.run(100);
  board.host.sleep();
  board.chip.run(1000);
  const from = board.paper.length;
  board.host.wake();
  board.prompt(from);
  assert.match(board.paper.slice(from), /DD\r\n>$/);
  assert.equal(board.tape, "", "nobody held the punch's line open");
  assert.equal(board.type("PRINT 2+2"), "4\r\n");
});

/** Prints 120 long lines, more than a line's queue holds. */
const LONG = ["5 I=0", "10 I=I+1", '20 PRINT "0123456789012345678901234567890123456789",I', "30 IF I<120 GOTO 10"];

test("a line that is shut: the run goes on, the oldest of the paper goes, and that is said", () => {
  const board = new Board({ punch: false });
  for (const line of LONG) board.type(line);
  board.host.send(board.host.tty, "RUN\r");
  board.chip.run(1);
  board.host.close(board.host.tty);
  board.chip.run(1500);
  const from = board.paper.length;
  board.host.open(board.host.tty);
  board.prompt(from);
  const seen = board.paper.slice(from);
  assert.match(seen, /\r\n\.\.\.\r\n/);
  assert.match(seen, /9 ?119\r\n\d+ ?120\r\nDD\r\n>$/);
  assert.equal(board.type("PRINT I"), "120\r\n");
});

test("a program at the terminal that does not read holds the board", () => {
  const board = new Board({ punch: false });
  for (const line of LONG) board.type(line);
  const start = board.paper.length;
  board.host.send(board.host.tty, "RUN\r");
  board.chip.run(2);
  board.host.tty.reads = false;
  board.chip.run(1500);
  const from = board.paper.length;
  board.host.tty.reads = true;
  board.prompt(from);
  const numbers = linesOf(board.paper.slice(start)).filter((line) => line.startsWith("0123")).map((line) => line.slice(40).trim());
  assert.deepEqual(numbers, Array.from({ length: 120 }, (_, i) => `${i + 1}`), "all of it");
});

test("who opens the second line begins a new tape, both ways", () => {
  const board = new Board({ punch: false });
  board.host.open(board.host.punch);
  board.host.punch.reads = false;
  board.program(part("xy-star"));
  board.type("RUN");
  board.host.send(board.host.punch, "10 REM OLD\r\n");
  board.chip.run(10);
  board.host.close(board.host.punch);
  board.chip.run(100);
  board.host.punch.reads = true;
  board.host.open(board.host.punch);
  board.chip.run(200);
  assert.equal(board.tape, "", "nothing is left of the old tape");
  board.host.send(board.host.punch, `20 REM NEW\r\n${CTRL_Z}`);
  board.type("NEW");
  board.type("LOAD");
  assert.deepEqual(board.listing, ["20 REM NEW"]);
});

test("garbage on both lines and in control requests", () => {
  const board = new Board();
  let seed = 1;
  const random = (n) => (seed = (seed * 48271) % 0x7fffffff) % n;
  for (const request of [[0x80, 6, 0x2200, 0, 64], [0xc0, 1, 0, 0, 8], [0x21, 0x55, 0, 9], [0x02, 3, 0, 0x82], [0x00, 3, 1, 0], [0x80, 6, 0x3ff, 0, 4]]) {
    assert.equal(board.host.control(...request), "stall", `${request}`);
  }
  assert.deepEqual(board.host.control(0x02, 1, 0, 0x82), [], "a halt that is cleared begins the packets anew");
  board.host.tty.inPid = 0;
  for (let i = 0; i < 6; i++) {
    const bytes = String.fromCharCode(...Array.from({ length: 150 }, () => random(256)).filter((c) => c !== 0x13));
    board.host.send(board.host.tty, bytes);
    board.host.send(board.host.punch, bytes);
    board.chip.run(200);
  }
  board.host.send(board.host.tty, `${CTRL_C}\r${CTRL_C}`);
  board.chip.run(300);
  board.host.send(board.host.tty, "\x15NEW\r");
  board.chip.run(300);
  assert.equal(board.type("PRINT 3*3"), "9\r\n");
});
