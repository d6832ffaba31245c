/* One line for each instruction: time, place, mnemonic, and the registers before it
 *
 *      28716 1A2B CALC1+2    CPI 40       A=50 F=.Z.P. BC=0D1B DE=2155 HL=2005 SP=25E6
 *
 * first the cycles since power-on, then address, label, instruction; of the flags S Z A (half carry) P C those that are
 * set. Before an operation of the calculator a line that begins with a semicolon names it and lists the float stack,
 * the top last:
 *
 *      ; 0D1A CUT+12     LA0 (3)         | 4 5
 */
#ifndef TRACE_H
#define TRACE_H

#include "calculator.h"

/* Prints the next instruction, and the operation if the calculator is about to do one; `s` and `k` may be NULL. */
void trace_instruction(const i8080 *c, const symbols *s, FILE *out);
void trace_operation(const i8080 *c, const calculator *k, FILE *out);

/* Tells whether the calculator is about to do an operation. */
bool trace_at_operation(const i8080 *c, const calculator *k);

#endif
