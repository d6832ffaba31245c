"use strict";
// Loaded in front of asm80 (node --require), which takes half the time then and writes the same image and listing:
// it asks for two operands of each line, and catches what node throws where there are fewer. Node looks through all
// of asm80 for the words of each of these messages. Here an operand that is not there is an empty one; the number
// of operands stays as it is.
const ASM = require("./node_modules/asm80/asm.js");

const EMPTY = { value: "", writable: true };
const TWO = Object.create(Array.prototype, { 0: EMPTY, 1: EMPTY });
const plain = ASM.pass2;
ASM.pass2 = (passed) => {
  for (const line of passed[0]) {
    line.params = Object.setPrototypeOf(line.params ?? [], TWO);
  }
  return plain(passed);
};
