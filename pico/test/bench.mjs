// Cycles of the RP2040 for one of the 8080, and the size of the program. `make bench-pico` prints them.
import { statSync } from "node:fs";
import { Board, part } from "./board.mjs";
import { ROOT } from "./chip.mjs";

const board = new Board();
board.program(part("cad-tape"));
const before = board.chip.counts;
board.type("RUN");
const after = board.chip.counts;
const ratio = (after.chip - before.chip) / (after.cycles - before.cycles);
const { size } = statSync(new URL("build/pico/skg-pico.bin", ROOT));
console.log(`pico: ${ratio.toFixed(2)} cycles of the chip for one of the 8080, ${(125 / ratio).toFixed(1)} MHz; flash ${size} bytes`);
