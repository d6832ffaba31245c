import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { ascii, Board, bytesOf, readNames } from "../src/board.ts";
import { differenceOf, LessonError, readLessons } from "../src/lessons.ts";
import { Recording } from "../src/recording.ts";

const FILES = ["web/src/lessons.md", "web/src/lessons.zh.md"].map((file) => readLessons(readFileSync(file, "utf8")));

/** What a program punches, laid out as the page has it. */
async function runner(): Promise<(program: string) => Recording> {
  const code = await WebAssembly.compile(readFileSync("web/wasm/board.wasm"));
  const board = await Board.create(code, readFileSync("roms/skg.bin"), readNames(readFileSync("roms/skg.sym", "latin1")));
  const type = (line: string): string => {
    board.type(bytesOf(`${line}\r`));
    while (board.run(1_000_000) !== "prompt");
    return ascii(board.takePaper());
  };
  type("");
  return (program) => {
    type("NEW");
    board.tape(bytesOf(program));
    assert.doesNotMatch(type("LOAD"), /ERR/, program);
    assert.doesNotMatch(type("RUN"), /ERR/, program);
    const recording = new Recording();
    recording.take(
      board.takePunched(),
      () => ({ name: "", program }),
      () => undefined,
    );
    return recording;
  };
}

test("ten steps in both languages, the same programs and tapes; each answer makes its tape, no start does", async () => {
  const [english, chinese] = FILES.map(({ steps }) => steps);
  assert.ok(english && chinese && english.length === 10);
  const given = (steps: typeof english) => steps.map(({ program, answer, tape }) => [program, answer, tape]);
  assert.deepEqual(given(chinese), given(english));
  const run = await runner();
  for (const { title, program, answer, tape, paragraphs } of english) {
    assert.ok(title && paragraphs.length > 1, title);
    const start = run(program);
    if (!tape) continue; // (one's own part)
    assert.ok(differenceOf(start.layout, tape), `${title}: there is something to do`);
    const done = run(answer);
    assert.equal(done.text, tape.replaceAll("\n", "\r\n"), title);
    assert.equal(differenceOf(done.layout, tape), undefined);
  }
});

test("the cut counts: not its direction, order, start hole or place; a hundredth of a millimetre does", async () => {
  const run = await runner();
  const program = (from: string, cut: string, r: string) => `10 R=${r}\n20 FROM ${from}\n30 CUT ${cut}\n40 BACK\n`;
  const wanted = run(program("(20,-5)", "X,Y:40,-X:30,-Y", "0.1")).text;
  const same = (...of: Parameters<typeof program>) => differenceOf(run(program(...of)).layout, wanted);
  assert.equal(same("(3,-8)", "X,Y:40,-X:30,-Y", "0.1"), undefined);
  assert.equal(same("(120,-5)", "X,Y:140,-X:30,-Y:-100", "0.1"), undefined);
  assert.equal(same("(20,-5)", "-X,Y,X:-30,-Y:-40", "-0.1"), undefined, "clockwise");
  assert.ok("block" in (same("(20,-5)", "X,Y:40.01,-X:30,-Y", "0.1") ?? {}));
  assert.ok("block" in (same("(20,-5)", "X,Y:40,2,-X:30,-Y", "0.1") ?? {}));
  const two = run(`${program("(20,-5)", "X,Y:40,-X:30,-Y", "0.1")}50 FROM (20,15)\n60 CUT (20,15):3\n70 BACK\n`).text;
  assert.ok("missing" in (differenceOf(run(program("(20,-5)", "X,Y:40,-X:30,-Y", "0.1")).layout, two) ?? {}));
});

test("a teacher's file: what is wrong, and where", () => {
  for (const [text, line, why] of [
    ["# Only a title\n", 1, "lessonStep"],
    ["## A\n\n```skg\n10 END\n", 3, "lessonFence"],
    ["## A\n\n```tape\nB1B2B2GYL1\nhello\n```\n", 5, "lessonTape"],
    ["## A\n\n```skg anser\n10 END\n```\n", 3, "lessonKind"],
    ["# Before a step\n\n```skg\n10 END\n```\n\n## A\n", 3, "lessonKind"],
  ] as const) {
    assert.throws(
      () => readLessons(text),
      (error) => error instanceof LessonError && error.line === line && error.why === why,
    );
  }
  const { title, paragraphs, steps } = readLessons(
    "# T\r\nIntro\r\n\r\n## One\r\nA\r\nb.\r\n```text\r\n## no step\r\n```\r\n```skg\r\n10 END\r\n```",
  );
  assert.deepEqual([title, paragraphs, steps.length], ["T", ["Intro"], 1]);
  assert.deepEqual(steps[0], { title: "One", paragraphs: ["A b."], program: "10 END\n", answer: "", tape: "" });
});
