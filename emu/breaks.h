/* Breakpoints of the debugger: addresses of machine code and of byte-code */
#ifndef BREAKS_H
#define BREAKS_H

#include "i8080.h"

enum { BREAKS = 32 };

typedef struct {
    uint16_t at[BREAKS];
    unsigned count;
} breaks;

bool breaks_has(const breaks *b, uint16_t address);

/* False when there are too many. One that is there already is set. */
bool breaks_set(breaks *b, uint16_t address);

/* False when there is none. */
bool breaks_delete(breaks *b, uint16_t address);

/* Tells the processor to stop at all of them, or at none any more. */
void breaks_arm(const breaks *b, i8080 *c, bool stops);

#endif
