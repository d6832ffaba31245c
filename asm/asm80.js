"use strict";
// node --max-semi-space-size=64 asm80.js FOLDER...
// Assembles top.asm of each folder with asm80, as its own program does, in one process: writes top.bin, 64 KiB from
// address 0 on, and top.lst there. The first fault ends it: a line with file and line number on stderr, exit code 1.
const { readFileSync, writeFileSync } = require("node:fs");
const { join } = require("node:path");
const ASM = require("./node_modules/asm80/asm.js");
const { hex2bin } = require("./node_modules/asm80/hextools.js");
const { I8080 } = require("./node_modules/asm80/monolith.js");
const { Parser } = require("./node_modules/asm80/parser.js");

// Two things that take most of asm80's time:
// It asks for two operands of each line, and catches what node throws where there are fewer. Node looks through all
// of asm80 for the words of each of these messages. Here an operand that is not there is an empty one; the number
// of operands stays as it is.
const EMPTY = { value: "", writable: true };
const TWO = Object.create(Array.prototype, { 0: EMPTY, 1: EMPTY });
const pass2 = ASM.pass2;
ASM.pass2 = (passed) => {
  for (const line of passed[0]) {
    line.params ??= [];
    if (line.params.length < 2) {
      Object.setPrototypeOf(line.params, TWO);
    }
  }
  return pass2(passed);
};
// It parses an operand anew in each of its eight passes.
const parsed = new Map();
const parse = Parser.parse;
Parser.parse = (text) => {
  const known = parsed.get(text) ?? parse(text);
  parsed.set(text, known);
  return known;
};

// It returns a fault, and prints it with its own stack.
console.log = () => {};
for (const folder of process.argv.slice(2)) {
  ASM.fileGet((name) => readFileSync(join(folder, name), "utf8"));
  const [fault, made] = ASM.compile(readFileSync(join(folder, "top.asm"), "utf8"), I8080);
  if (fault) {
    const { includedFile, numline, line } = fault.s ?? {};
    console.error(fault.msg ? `${includedFile ?? "top.asm"}:${numline}: ${fault.msg}: ${line?.trim()}` : `${fault}`);
    process.exit(1);
  }
  writeFileSync(join(folder, "top.bin"), hex2bin(ASM.hex(made[0]), 0, 0xffff));
  writeFileSync(join(folder, "top.lst"), ASM.lst(made[0], made[1]));
}
