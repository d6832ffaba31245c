/* 8080 machine code as Intel's mnemonics, with the firmware's names where there are any */
#ifndef DISASM_H
#define DISASM_H

#include "symbols.h"

enum { DISASM_TEXT = 8 + SYMBOLS_NAMES };

/* Writes the instruction whose bytes begin at code[0] (three can be read) and gives its length. An undocumented
 * duplicate is written as the instruction that it duplicates. A word is a label or cell of `s` (which may be NULL) or
 * hexadecimal. */
unsigned disasm(const symbols *s, const uint8_t code[3], char text[DISASM_TEXT]);

#endif
