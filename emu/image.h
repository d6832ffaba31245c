/* Files of bytes: whole files, and ROM images as .bin or Intel .hex
 *
 *      :LLAAAATTDD...CC    LL bytes DD for address AAAA; TT 00 data, 01 end; CC makes the sum of all bytes 0
 *
 * NOT IMPLEMENTED: .hex records of addresses past FFFF (types 02 to 05, but for those that say nothing new).
 */
#ifndef IMAGE_H
#define IMAGE_H

#include <stddef.h>
#include <stdint.h>

/* Reads a whole file into fresh memory (free it), and one NUL more. NULL when that cannot be done or it has more than
 * `limit` bytes: then `error` (of `size` bytes) says why, in one line with the file's name. */
uint8_t *image_read(const char *path, size_t limit, size_t *length, char *error, size_t size);

/* Reads a ROM image of at most `rom_size` bytes from address 0, the rest FF, into `rom`; Intel hex when the name ends in
 * .hex. Returns 0, or -1 with `error` as above. */
int image_rom(const char *path, uint8_t *rom, size_t rom_size, char *error, size_t size);

#endif
