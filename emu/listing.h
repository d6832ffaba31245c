/* Machine code as a listing: an instruction a line, and what stands behind its restarts */
#ifndef LISTING_H
#define LISTING_H

#include "calculator.h"

/* The most lines of one listing. */
enum { LISTING_LONGEST = 1000 };

/* Prints so many instructions from an address on, each behind its address and its place (symbols_place), and the data
 * behind a restart: a byte behind RST 1 and RST 4, byte-code behind RST 5. `k` NULL: a firmware without a calculator,
 * whose restarts have no data. */
void listing_print(const symbols *s, const calculator *k, const i8080 *c, uint16_t address, unsigned count, FILE *out);

#endif
