/* Breakpoints of the debugger. See breaks.h. */
#include "breaks.h"

bool breaks_has(const breaks *b, uint16_t address)
{
    for (unsigned i = 0; i < b->count; i++) {
        if (b->at[i] == address) {
            return true;
        }
    }
    return false;
}

bool breaks_set(breaks *b, uint16_t address)
{
    if (breaks_has(b, address)) {
        return true;
    }
    if (b->count == BREAKS) {
        return false;
    }
    b->at[b->count++] = address;
    return true;
}

bool breaks_delete(breaks *b, uint16_t address)
{
    for (unsigned i = 0; i < b->count; i++) {
        if (b->at[i] == address) {
            b->at[i] = b->at[--b->count];
            return true;
        }
    }
    return false;
}

void breaks_arm(const breaks *b, i8080 *c, bool stops)
{
    for (unsigned i = 0; i < b->count; i++) {
        i8080_break(c, b->at[i], stops);
    }
}
