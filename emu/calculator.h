/* The firmware's calculator as readable text: byte-code by its names, floats as decimal numbers
 *
 * All names come from the firmware's symbols (asm/calc.asm, ops.asm, consts.asm, equ.asm): an operation is a Q name below
 * 40H, one that begins with QJ is followed by a distance; a register is a pair of names, Lxx of 40H to 7FH and Sxx 40H
 * above it; a constant is a Q name from C0H up to QRET, its value stands in CONTAB; from there on an operation's
 * number is added to QRET. Registers and constants may have several names, or none.
 *
 * NOT IMPLEMENTED: finding byte-code in the ROM: the caller gives an address in it.
 */
#ifndef CALCULATOR_H
#define CALCULATOR_H

#include "i8080.h"
#include "symbols.h"

#include <stdio.h>

enum { CALCULATOR_CODES = 256, CALCULATOR_REGISTERS = 64, CALCULATOR_TEXT = 64 };

typedef struct {
    const symbols *names;
    uint16_t next;                  /* CALC1: the next operation is the byte at BC */
    uint16_t stack, stack_pointer;  /* FSTK; FSP: the cell that points to the top, its low byte counts */
    uint16_t registers, constants;  /* MREG, CONTAB */
    uint8_t end, leave;             /* byte-code ends with one of them: QEND; QRET or a higher byte */
    char code[CALCULATOR_CODES][CALCULATOR_TEXT];       /* empty: no name */
    bool distance[CALCULATOR_CODES];
} calculator;

/* Collects the names. NULL, or the name that is missing among them. */
const char *calculator_init(calculator *k, const symbols *names);

/* A float of the firmware's (five bytes: exponent, excess 128; sign and mantissa). */
double calculator_float(const uint8_t bytes[5]);

/* Writes the operation at an address: its name and, behind a register or a constant, its value now; behind a jump, its
 * target. Gives its length. */
unsigned calculator_operation(const calculator *k, const i8080 *c, uint16_t address, char text[CALCULATOR_TEXT]);

/* Prints the float stack, the top last, on the rest of a line. */
void calculator_print_stack(const calculator *k, const i8080 *c, FILE *out);

/* Prints registers under their names, one a line: the one that is called so (with or without its L or S), or all that have
 * a name and are not 0 when `name` is NULL. False when there is no such register. */
bool calculator_print_registers(const calculator *k, const i8080 *c, const char *name, FILE *out);

/* Prints byte-code from an address on, for so many operations or up to its end: QEND, or a QRET (with an operation or
 * without) that no jump in front of it leads past. Gives the address behind. */
uint16_t calculator_print_code(const calculator *k, const i8080 *c, uint16_t address, unsigned count, FILE *out);

#endif
