import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { Board, bytesOf, readNames } from "../src/board.ts";
import { Firmware, hex } from "../src/firmware.ts";

const SYM = readFileSync("roms/skg.sym", "latin1");
const MODULE = new WebAssembly.Module(readFileSync("web/wasm/inside.wasm"));
const firmware = await Firmware.create(MODULE, SYM);

/** The output of `skg80 --debug` (tests/web/test_page.py). */
interface Said {
  stop: string;
  floats: string;
  registers: string[];
  listings: string[];
}

const SAID = JSON.parse(readFileSync(`${process.env["PAGE_TEST"]}/debugger.json`, "utf8")) as Said[];

async function booted(): Promise<Board> {
  const module = await WebAssembly.compile(readFileSync("web/wasm/board.wasm"));
  const board = await Board.create(module, readFileSync("roms/skg.bin"), readNames(SYM));
  while (board.run(1_000_000) !== "prompt");
  return board;
}

/** The board with the wrench, LOADed and RUN, where it stops the second time. */
async function stopped(stop: string): Promise<Board> {
  const board = await booted();
  board.tape(readFileSync("examples/wrench.skg"));
  assert.ok(board.stopAt(firmware.address(stop) ?? -1, true));
  board.type(bytesOf("LOAD\rRUN\r"));
  for (let slices = 0, times = 0; slices < 2000; slices++) {
    if (board.run(1_000_000) !== "break") continue;
    if (++times === 2) return board;
    board.step("instruction", 0, 1e9);
  }
  throw new Error(`no ${stop}`);
}

test("all of the ROM, the float stack and the registers as skg80's debugger prints them", async () => {
  let listed = 0;
  for (const { stop, floats, registers, listings } of SAID) {
    const { memory, pc, bc } = (await stopped(stop)).look();
    firmware.look(memory);
    assert.equal(firmware.place(pc === firmware.value("CALC1") ? bc : pc), stop);
    assert.equal(firmware.floats().join(" "), floats, stop);
    assert.deepEqual(
      firmware.registers().map(({ number, names, value }) => `${number} ${names} ${value}`),
      registers.map((line) => line.trim().replace(/ +/g, " ")),
      stop,
    );
    for (const [from, text] of listings.entries()) {
      const lines = firmware.listing(from, 1).map(({ address, place, text }) => `${hex(address)} ${place.padEnd(10)} ${text}\n`);
      assert.equal(lines.join(""), text, hex(from));
      listed++;
    }
  }
  assert.equal(listed, 8192);
});

test("names, addresses and source files", async () => {
  assert.equal(firmware.address("calc1+2"), (firmware.value("CALC1") ?? 0) + 2);
  assert.equal(firmware.place((firmware.value("CALC1") ?? 0) + 2), "CALC1+2");
  assert.equal(firmware.file(firmware.value("CALC1") ?? 0), "calc");
  assert.equal(firmware.address("1FFF"), 0x1fff);
  assert.equal(firmware.file(0xc000), "");
  for (const none of ["", "NOWHERE", "CALC1+", "12345", "CALC1+1X"]) assert.equal(firmware.address(none), undefined, none);
  await assert.rejects(Firmware.create(MODULE, "not a symbol file"), /skg\.sym:1/);
  await assert.rejects(Firmware.create(MODULE, "0000 NAME float\n"), /CALC1/);
});

test("a part is the same, byte for byte, when the board is stopped a thousand times on the way", async () => {
  const board = await stopped("ADVANC");
  for (let steps = 0; steps < 1000; steps++) assert.equal(board.step(steps % 2 ? "operation" : "instruction", 0, 1e9), "break");
  const { sp } = board.look();
  assert.equal(board.step("return", sp, 1e9), "break");
  assert.ok(board.look().sp > sp);
  const punched = board.takePunched();
  for (let stops = 0; ; stops++) {
    const first = board.step("instruction", 0, 1e9);
    assert.equal(first, "break");
    const reason = board.run(1e9);
    punched.push(...board.takePunched());
    if (reason === "prompt") {
      assert.ok(stops > 10, `${stops} stops`);
      break;
    }
  }
  assert.ok("mark" in (punched[0] ?? {}), "RUN");
  const tape = punched.map((each) => ("text" in each ? `${each.text}\r\n` : "")).join("");
  assert.equal(tape, readFileSync("examples/wrench.3b", "latin1"));
});
