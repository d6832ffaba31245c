/* A CP/M program on a bare 8080 with 64 KiB, enough for the public exercisers
 *
 *      0000  OUT 0         a jump here ends the program
 *      0005  OUT 1, RET    BDOS: C = 0 end, 2 print E, 9 print the string at DE up to `$`
 *      0006  word C901     the end of memory, for the program
 *      0100  the program, entered with a stack whose top word is 0000
 *
 * NOT IMPLEMENTED: every other BDOS function, BIOS, disks, the console's input.
 */
#ifndef COM_H
#define COM_H

#include "i8080.h"

#include <stdio.h>

enum { COM_START = 0x100, COM_SIZE = 0xc700 };

typedef enum { COM_ENDED, COM_CYCLES, COM_HALTED, COM_UNKNOWN } com_end;

/* Runs the program for at most that many cycles, printing to `out`. COM_UNKNOWN: it called a BDOS function that is not
 * implemented; `c->bc` holds its number. */
com_end com_run(i8080 *c, const uint8_t *program, size_t length, uint64_t cycles, FILE *out);

#endif
