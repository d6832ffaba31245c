/* Writing the flash, by the boot ROM's routines (RP2040 data sheet 2.8.3.1.3). Offsets are from the flash's beginning.
 *
 * It takes up to some tenths of a second, in which the chip does nothing else.
 */
#ifndef PICO_FLASH_H
#define PICO_FLASH_H

#include <stdint.h>

enum { FLASH_PAGE = 256, FLASH_SECTOR = 4096 };

/* The flash as memory. */
const uint8_t *flash_at(uint32_t offset);

/* Erases whole sectors: all bytes become FF. */
void flash_erase(uint32_t offset, uint32_t size);

/* Writes a page that was erased. */
void flash_write(uint32_t offset, const uint8_t page[FLASH_PAGE]);

#endif
