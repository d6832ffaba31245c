/* Memory that survives power off: copies in the flash's second MiB
 *
 * A shelf is four places of 64 KiB; the next copy goes into the place of the oldest one, and none is touched but that. A copy is
 * a page with its number, its sum and some bytes of its owner's (`about`), and pages of data. The first page is written
 * last, so a copy that was not finished is none, and the one before it counts. At 100,000 erasures of a place a shelf takes
 * 400,000 copies.
 */
#ifndef PICO_STORE_H
#define PICO_STORE_H

#include "flash.h"

#include <stdbool.h>

enum { STORE_ABOUT = 240, STORE_PAGES = 255, STORE_SHELVES = 4 };

/* The first page of a copy. */
typedef struct {
    uint32_t magic, number; /* copies of a shelf are numbered on and on */
    uint32_t pages;         /* of data, behind this one */
    uint8_t about[STORE_ABOUT];
    uint32_t sum; /* CRC-32 of the rest of this page and of the data */
} store_copy;

/* The newest copy of a shelf in the flash, its data behind it; NULL: there is none. `torn`: a newer one was begun. */
const store_copy *store_newest(unsigned shelf, bool *torn);

/* Keeps a copy; `pages` are its data, FLASH_PAGE bytes each. */
void store_keep(unsigned shelf, const uint8_t about[STORE_ABOUT], const uint8_t *const pages[], uint32_t count);

/* The CRC-32 of zip and Ethernet, continued from `sum`; 0 begins one. */
uint32_t store_sum(uint32_t sum, const void *bytes, uint32_t size);

#endif
