/* Signs that are not ASCII, on their way into the board
 *
 * Word processors, web pages and Chinese keyboards write a minus, a quote or a bracket that the board has in another
 * form: it becomes the ASCII sign. The board would take any other byte above 127 without its bit 7, as a sign that
 * nobody typed: it is refused. tools/skg/signs.py and web/src/signs.ts have the same table; a test compares them.
 */
#ifndef SIGNS_H
#define SIGNS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    SIGNS_STRANGE = -1, /* no sign of the board's */
    SIGNS_MORE = -2,    /* the beginning of a character in UTF-8 */
    SIGNS_SHOWN = 16    /* room for signs_show */
};

/* Reads one character in UTF-8: its ASCII sign, SIGNS_STRANGE, or SIGNS_MORE. `used`: its bytes; of no UTF-8, one. */
int signs_read(const uint8_t *bytes, size_t length, size_t *used);

/* Writes a strange character for a message: itself, its number where it would not be seen, or its byte. */
void signs_show(const uint8_t *bytes, size_t used, char shown[SIGNS_SHOWN]);

/* Tells whether bit 7 of a paper tape is parity: even, odd or always 1, blank and deleted characters aside. */
bool signs_have_parity(const uint8_t *bytes, size_t length);

#endif
