import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { test } from "node:test";
import { ascii, Board, bytesOf, type PunchedLine, type PunchMark, readNames } from "../src/board.ts";
import { Recording } from "../src/recording.ts";

const SYM = readFileSync("roms/skg.sym", "latin1");

async function started(): Promise<Board> {
  const module = await WebAssembly.compile(readFileSync("web/wasm/board.wasm"));
  const board = await Board.create(module, readFileSync("roms/skg.bin"), readNames(SYM));
  untilPrompt(board);
  return board;
}

function untilPrompt(board: Board): string {
  for (let slices = 0; slices < 2000; slices++) {
    const reason = board.run(1_000_000);
    if (reason === "prompt") return ascii(board.takePaper());
    assert.ok(reason === "cycles" || reason === "wait", reason);
  }
  throw new Error("no prompt");
}

function type(board: Board, line: string): string {
  board.type(bytesOf(`${line}\r`));
  return untilPrompt(board);
}

/** The marks and the lines that the punch has given since. */
function punched(board: Board): { marks: PunchMark[]; lines: PunchedLine[] } {
  const all = board.takePunched();
  return { marks: all.filter((each) => "mark" in each), lines: all.filter((each) => "text" in each) };
}

/** Loads and runs a program; what was punched. */
function run(board: Board, program: string): PunchedLine[] {
  type(board, "NEW");
  board.tape(bytesOf(program));
  type(board, "LOAD");
  board.takePunched();
  type(board, "RUN");
  const { marks, lines } = punched(board);
  assert.deepEqual(marks, [
    { mark: "run", from: 0 },
    { mark: "prompt", from: 0 },
  ]);
  return lines;
}

const text = (punched: readonly PunchedLine[]): string => punched.map((line) => `${line.text}\r\n`).join("");

test("every example's tape, byte for byte", async () => {
  const board = await started();
  const names = readdirSync("examples").filter(
    (file, _, all) => file.endsWith(".skg") && all.includes(file.replace(/skg$/, "3b")),
  );
  assert.ok(names.length > 40);
  for (const name of names) {
    const tape = readFileSync(`examples/${name.replace(/skg$/, "3b")}`, "latin1");
    assert.equal(text(run(board, readFileSync(`examples/${name}`, "latin1"))), tape, name);
  }
});

test("which program line made a block, and where the wire stands behind it", async () => {
  const punched = run(
    await started(),
    [
      "10 FROM (0,-5)",
      "20 CUT X",
      "30 CUT Y:40,3",
      "40 CUT -X:30",
      "50 CUT -Y",
      "60 BACK",
      "70 FROM (10,10)",
      "80 CUT (20,10):2",
      "90 BACK",
      "100 END",
      "",
    ].join("\n"),
  );
  assert.deepEqual(
    punched.map(({ text: block, line, x, y }) => [block.slice(-4), line, x, y]),
    [
      // the way in comes with the first element; each element's block is its own line's, a fillet its second element's
      ["GYL2", 20, 0, 0],
      ["GXL1", 20, 40000, 0],
      ["GYL2", 30, 40000, 27000],
      ["XNR1", 40, 37000, 30000],
      ["GXL3", 40, 0, 30000],
      ["GYL4", 50, 0, 0],
      ["GYL4", 60, 0, -5000],
      ["D", 70, 0, -5000],
      ["GYL1", 70, 10000, 10000],
      ["D", 70, 10000, 10000],
      ["GXL1", 80, 18000, 10000],
      ["YNR3", 80, 18000, 10000],
      ["GXL3", 90, 10000, 10000],
      ["DD", 100, 10000, 10000],
    ],
  );
});

test("after an error, and by a direct statement", async () => {
  const board = await started();
  run(board, "10 CUT X,Y:10\n20 CUT (50,50):1\n30 END\n");
  board.takePunched();
  const again = run(board, "10 FROM (5,5)\n20 CUT (20,5):2\n30 BACK\n40 END\n");
  assert.deepEqual(
    again.map(({ line }) => line),
    [20, 20, 30, 40],
  );
  type(board, "FROM (0,0)");
  type(board, "CUT (10,0):1");
  type(board, "BACK");
  const typed = punched(board);
  assert.ok(typed.lines.length > 2 && typed.lines.every(({ line }) => line === 0));
  assert.ok(typed.marks.every(({ mark }) => mark === "prompt"));
});

test("the memory: a reset keeps program and variables, LIST on the second board disturbs nothing", async () => {
  const board = await started();
  type(board, "10 A=2");
  type(board, "B=3:2*0");
  type(board, "I=7");
  const ram = board.save();
  assert.equal(board.list(ram), "10 A=2\n");
  assert.match(type(board, "PRINT I"), /\r\n7\r\n/);
  const other = await started();
  other.restore(ram);
  untilPrompt(other);
  assert.match(type(other, "PRINT I"), /\r\n7\r\n/);
  assert.equal(other.list(other.save()), "10 A=2\n");
  // a program that is not whole is lost, and the board says so
  const wrong = ram.slice().fill(0x55, 1700, 1760);
  other.restore(wrong);
  assert.match(untilPrompt(other), /DAMAGED/);
});

test("a line with RUN that is only looked at begins no tape", async () => {
  const board = await started();
  run(board, "10 CUT O,(5,0)\n");
  for (const line of ["10 RUN", "RUN,", "RUN 1.5.5"]) {
    assert.match(type(board, line), /ERR 01/, line);
    assert.deepEqual(board.takePunched(), [{ mark: "prompt", from: 0 }], line);
  }
  assert.match(type(board, "RUN 20"), /ERR 02/);
  assert.deepEqual(board.takePunched(), [{ mark: "prompt", from: 0 }], "a line that is not there begins nothing");
  type(board, "RUN 10");
  assert.deepEqual(punched(board).marks[0], { mark: "run", from: 10 });
});

test("a line on the punch that is not whole yet waits", async () => {
  const board = await started();
  type(board, "NEW");
  board.tape(bytesOf("10 FROM O\n20 CUT (20,0):5\n30 BACK\n40 END\n"));
  type(board, "LOAD");
  board.baud(110);
  board.type(bytesOf("RUN\r"));
  const found: string[] = [];
  for (let turns = 0; turns < 5000 && found.at(-1) !== "DD"; turns++) {
    board.run(30_000);
    found.push(...punched(board).lines.map((line) => line.text));
  }
  assert.deepEqual(found, ["B15000B0B15000GXL1", "B5000B0B20000GYNR3", "B15000B0B15000GXL3", "DD"]);
  assert.ok(board.cycles > 2_000_000 * 5, "110 baud takes its time");
});

test("names that are not in skg.sym are said", () => {
  assert.throws(() => readNames(SYM.replace(/^.* CURLIN.*$/m, "")), /CURLIN/);
});

test("one recording a RUN: the half block of a reset, and what is typed at the prompt, are in no program's tape", async () => {
  const board = await started();
  const recording = new Recording();
  const made = { name: "wrench", program: "" };
  let begun = 0;
  const take = (): void =>
    void recording.take(
      board.takePunched(),
      () => made,
      () => begun++,
    );
  const tape = readFileSync("examples/wrench.3b", "latin1");
  type(board, "NEW");
  board.tape(readFileSync("examples/wrench.skg"));
  type(board, "LOAD");
  take();
  assert.equal(begun, 0);

  // the reset button in the middle of a block, with the punch at its own pace
  board.baud(110);
  board.type(bytesOf("RUN\r"));
  for (let turns = 0; turns < 200_000 && recording.layout.blocks.length < 3; turns++) {
    board.run(10_000);
    take();
  }
  board.run(2_000_000); // (ten characters more)
  board.reset();
  board.baud(0);
  untilPrompt(board);
  take();
  const [, ...rest] = tape.split("\r\n");
  assert.ok(recording.layout.blocks.length >= 3 && recording.layout.blocks.length < rest.length);
  assert.equal(recording.text, tape.slice(0, recording.text.length), "whole blocks alone");
  assert.equal(recording.isWhole, false);
  type(board, "RUN");
  take();
  assert.deepEqual([recording.text, recording.how, recording.isWhole], [tape, "run", true]);

  // SAVE leaves it alone, and is a program
  type(board, "SAVE");
  take();
  assert.equal(recording.takeProgram(), board.list(board.save()));
  assert.equal(recording.takeProgram(), undefined);
  assert.equal(recording.text, tape);

  // typed statements behind a whole tape make another one, whatever program lines they go to
  for (const line of ["GOTO 170", "FROM (5,5)", "END"]) {
    type(board, line);
    take();
    assert.equal(recording.how, "typed", line);
  }
  type(board, "RUN 170");
  take();
  assert.deepEqual([recording.how, recording.from], ["part", 170]);

  // behind one without its end they go on
  type(board, "172 CUT X,X:1");
  type(board, "RUN");
  take();
  assert.deepEqual([recording.how, recording.isWhole], ["run", false]);
  const broken = recording.text;
  type(board, "END");
  take();
  assert.deepEqual([recording.how, recording.isWhole, recording.text], ["mixed", true, `${broken}DD\r\n`]);
});
