/* The firmware's names, from a .sym file that asm/build.py writes
 *
 *      VVVV NAME           an equate: a number, a character, an operation, a cell of RAM
 *      VVVV NAME file      a label of ROM, and the source file in which it stands
 *
 * NOT IMPLEMENTED: names of more than SYMBOLS_NAME characters, files of more than SYMBOLS_FILE.
 */
#ifndef SYMBOLS_H
#define SYMBOLS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { SYMBOLS_NAME = 15, SYMBOLS_FILE = 63 };

typedef struct {
    uint16_t value;
    bool label;                     /* of ROM; else an equate */
    char name[SYMBOLS_NAME + 1];
    char file[SYMBOLS_FILE + 1];    /* of a label: its source file in asm/, without .asm */
} symbol;

typedef struct {
    symbol *all;                    /* as in the file */
    size_t count;
    const symbol *label_at[0x2000]; /* the last label at or in front of each address of the ROM; NULL: none */
} symbols;

/* Reads the text of a .sym file; free with symbols_free. NULL when it is none: then `error` (of `size` bytes) holds the
 * reason, beginning with `path`. */
symbols *symbols_new(const char *path, const char *text, char *error, size_t size);
void symbols_free(symbols *s);

/* The value of a name, in any case. */
bool symbols_value(const symbols *s, const char *name, uint16_t *value);

/* The label at or in front of an address; NULL where there is none near it. */
const symbol *symbols_label(const symbols *s, uint16_t address);

/* An address as a label and a distance: `CALC1+2`; four hexadecimal digits where there is no label near it. `size` bytes
 * of `text` are enough when they are SYMBOLS_PLACE. */
enum { SYMBOLS_PLACE = SYMBOLS_NAME + 8 };
const char *symbols_place(const symbols *s, uint16_t address, char text[SYMBOLS_PLACE]);

/* The names of exactly that address, a label or cells of RAM: `MWORK/TXTP`; NULL: none. SYMBOLS_NAMES is enough for
 * `text`; names that do not fit are left out. */
enum { SYMBOLS_NAMES = 32 };
const char *symbols_exact(const symbols *s, uint16_t address, char text[SYMBOLS_NAMES]);

/* An address as a user writes it: a label or a cell, one of them and a distance (`CALC1+2`), or hexadecimal digits. False
 * when it is none of these. */
bool symbols_address(const symbols *s, const char *text, uint16_t *address);

#endif
