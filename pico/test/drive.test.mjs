// Two motors: every pulse as skg80's, the feed, the stop line, the pen.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import test from "node:test";
import { Board, part } from "./board.mjs";
import { ROOT } from "./chip.mjs";


/** Two contours with a move between them, lines in all quadrants, arcs both ways across an axis: some thousand steps. */
const PART = `10 SCALE .02
20 FROM (0,0)
30 CUT (2,1),(9,3),(7,8),(4,6),(2,1)
40 C=(20,5):3
50 FROM (20,5)
60 CUT C
70 BACK
80 END
`;

/** The steps and the tape of skg80 with the same ROM. */
function ofSkg80(program) {
  const folder = mkdtempSync(join(tmpdir(), "skg-"));
  const [steps, file] = [join(folder, "steps"), join(folder, "part.skg")];
  writeFileSync(file, program);
  const words = ["--rom", "roms/skg-drive.bin", "--steps", steps, file];
  const punched = execFileSync("build/skg80", words, { cwd: fileURLToPath(ROOT), stdio: "pipe" });
  return { steps: [...readFileSync(steps)], tape: punched.toString("latin1") };
}

const parts = (process.env.PICO_DRIVE ?? "").split(" ").filter((name) => name);
for (const program of [PART, ...parts.map(part)]) {
  test(`DRIVE 1 and RUN: each pulse is skg80's`, () => {
    const wanted = ofSkg80(program);
    assert.ok(wanted.steps.length > 300, `${wanted.steps.length}`);
    const board = new Board({ rom: "DRIVE" });
    board.program(program);
    board.type("DRIVE 1");
    board.drive("RUN");
    assert.equal(board.tape, wanted.tape);
    assert.deepEqual(board.chip.steps, wanted.steps);
    assert.ok(board.chip.leastSetup > 2000, `a direction stands ${board.chip.leastSetup} ns before its pulse`);
    const fastest = Math.min(...board.chip.stepTimes.slice(1).map((time, i) => time - board.chip.stepTimes[i]));
    console.log(`${wanted.steps.length} steps; at full speed one in ${fastest / 1000} us`);
  });
}

test("DRIVE of a tape from the second line", () => {
  const board = new Board({ rom: "DRIVE" });
  board.host.send(board.host.punch, "B0B0B500GXL1\r\nB300B400B400GYL2\r\nDD\r\n");
  board.drive("DRIVE");
  const [first, last] = [board.chip.steps.slice(0, 500), board.chip.steps.slice(500)];
  assert.ok(first.every((step) => step === 0x81));
  assert.equal(last.length, 700);
  assert.equal(last.filter((step) => step & 4).length, 400);
});

test("the feed: 500 and 3,333 steps a second, and a pin", () => {
  const board = new Board({ rom: "DRIVE", feed: 500 });
  const pace = (feed, tolerance) => {
    board.chip.steps.length = board.chip.stepTimes.length = 0;
    board.host.send(board.host.punch, "B0B0B100GXL1\r\nDD\r\n");
    board.drive("DRIVE");
    const times = board.chip.stepTimes;
    assert.equal(times.length, 100);
    const gaps = times.slice(1).map((time, i) => time - times[i]);
    const mean = (times.at(-1) - times[0]) / 99;
    assert.ok(Math.abs(mean * feed - 1e9) < 1e9 / 500, `${mean} ns`);
    for (const gap of gaps.slice(10)) assert.ok(Math.abs(gap * feed - 1e9) < 1e9 * tolerance, `${gap} ns`);
  };
  pace(500, 0.03);
  board.type("#FEED 3333");
  pace(3333, 0.15);
  board.type("#FEED PIN");
  const pin = board.chip.mcu.gpio[8];
  let high = false;
  const wave = board.chip.clock.createAlarm(() => {
    pin.setInputValue((high = !high));
    wave.schedule(0.5e6);
  });
  wave.schedule(0.5e6);
  pace(1000, 0.05);
});

test("the pen and the servo: no step while it moves; nothing cuts at the prompt", () => {
  const board = new Board({ rom: "DRIVE", feed: 5000 });
  board.host.send(board.host.punch, "B0B0B10GXL1\r\nD\r\nB0B0B10GXL1\r\nD\r\nB0B0B10GXL1\r\nDD\r\n");
  board.chip.servo.length = 0;
  board.drive("DRIVE");
  assert.deepEqual(board.chip.steps, [...Array(10).fill(0x81), ...Array(10).fill(1), ...Array(10).fill(0x81)]);
  assert.equal(board.chip.cutting, false);
  board.chip.run(50);
  const lengths = board.chip.servo.filter((length, i, all) => length !== all[i - 1]);
  assert.deepEqual(lengths, [1750, 1250, 1750, 1250].slice(lengths[0] === 1250 ? 1 : 0), `${board.chip.servo}`);
});

test("the stop line: between two steps, and on from there at the next key", () => {
  const board = new Board({ rom: "DRIVE" });
  board.chip.stopAtStep = 40;
  board.host.send(board.host.punch, "B0B0B100GXL1\r\nDD\r\n");
  const from = board.paper.length;
  board.host.send(board.host.tty, "DRIVE\r");
  board.prompt(from);
  assert.match(board.paper.slice(from), /ERR 10/);
  assert.equal(board.chip.steps.length, 40);
  assert.equal(board.chip.cutting, false);
  board.chip.stop = false;
  board.host.send(board.host.tty, "DRIVE\r");
  board.chip.run(20);
  board.host.send(board.host.tty, "\r");
  board.prompt(board.paper.length);
  assert.equal(board.chip.steps.length, 100);
});

test("an open wire at the stop line stops, and a break in the middle of a drive ends pulse and cut", () => {
  const board = new Board({ rom: "DRIVE", feed: 1000 });
  board.chip.stop = true; // (pulled up: nothing is connected)
  board.host.send(board.host.punch, "B0B0B9000GXL1\r\nDD\r\n");
  assert.match(board.type("DRIVE"), /ERR 10/);
  assert.equal(board.chip.steps.length, 0);
  assert.ok(board.chip.mcu.gpio[7].pullupEnabled);
  board.chip.stop = false;
  board.host.send(board.host.tty, "DRIVE\r");
  board.chip.run(20);
  board.host.send(board.host.tty, "\r");
  board.chip.run(400);
  assert.ok(board.chip.cutting && board.chip.steps.length > 50);
  board.host.break();
  board.chip.run(300);
  assert.equal(board.chip.mcu.sio.gpioValue & 0x54, 0);
  const { length } = board.chip.steps;
  board.chip.run(50);
  assert.equal(board.chip.steps.length, length);
});
