// Cycles of the RP2040 for one of the 8080, and the size of the program. `make bench-pico` prints them, with exit 1 where
// the cycles, which are exact, pass their limit: so does a compiler that makes slower code of the same.
import { statSync } from "node:fs";
import { Board, part } from "./board.mjs";
import { ROOT } from "./chip.mjs";

const LIMIT = 8.5;

const board = new Board();
board.program(part("cad-tape"));
const before = board.chip.counts;
board.type("RUN");
const after = board.chip.counts;
const ratio = (after.chip - before.chip) / (after.cycles - before.cycles);
const { size } = statSync(new URL("build/pico/skg-pico.bin", ROOT));
const what = "cycles of the Pico's chip for one of the 8080".padEnd(46);
const bound = `<= ${LIMIT}`.padStart(11);
console.log(`pico: ${(125 / ratio).toFixed(1)} MHz; flash ${size} bytes`);
console.log(`${what} ${ratio.toFixed(2).padStart(12)}   ${bound}${ratio > LIMIT ? "   PASSED" : ""}`);
process.exitCode = ratio > LIMIT ? 1 : 0;
