/* Files of bytes: whole files, and ROM images as .bin or Intel .hex
 *
 *      :LLAAAATTDD...CC    LL bytes DD for address AAAA; TT 00 data, 01 end; CC makes the sum of all bytes 0
 *
 * NOT IMPLEMENTED: .hex records of addresses past FFFF (types 02 to 05, except those that change nothing).
 */
#ifndef IMAGE_H
#define IMAGE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { IMAGE_FILE_LIMIT = 1 << 20 };    /* bytes that a file with a ROM may have */

/* Reads a whole file into fresh memory (free it), and one NUL more. NULL when that fails or it has more than
 * `limit` bytes: then `error` (of `size` bytes) holds the reason, in one line with the file's name. */
uint8_t *image_read(const char *path, size_t limit, size_t *length, char *error, size_t size);

/* Reads the image of a ROM of `rom_size` bytes into `rom`; Intel hex when the name ends in .hex. A binary image must
 * have exactly that many bytes; an Intel hex file may leave some out, which then are FF; `given` marks the others.
 * Returns 0, or -1 with `error` as above. */
int image_rom(const char *path, uint8_t *rom, bool *given, size_t rom_size, char *error, size_t size);

/* Faults of an image; tools/skg/board/emulator.py has the same order. */
enum image_fault {
    IMAGE_GOOD,
    IMAGE_LENGTH,
    IMAGE_NO_TEXT,
    IMAGE_NO_RECORD,
    IMAGE_RECORD_LENGTH,
    IMAGE_CHECKSUM,
    IMAGE_PAST_ROM,
    IMAGE_PAST_FFFF,
    IMAGE_KIND,
    IMAGE_AFTER_END,
    IMAGE_NO_END
};

/* The same of a file's bytes, which end in a NUL and are changed. `line`: the one that is wrong, from 1; 0: none. */
enum image_fault image_rom_of(const char *path, char *bytes, size_t length, uint8_t *rom, bool *given, size_t rom_size,
                              int *line);

#ifdef SKG80_BUILT_IN_ROM
extern const uint8_t skg80_rom[]; /* roms/skg.bin, and its names; by rom.S */
extern const char skg80_sym[];
#endif

/* The CRC-32 of some bytes, as zip and gzip have it. */
uint32_t image_crc32(const uint8_t *bytes, size_t length);

#endif
