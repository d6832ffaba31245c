/* noise: random input to the teletype: typing errors, line noise, valid and invalid programs
 *
 * A text grows by pieces; every piece is random, and the same seed gives the same text.
 */
#ifndef NOISE_H
#define NOISE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { NOISE_ROOM = 1 << 16 };

typedef struct {
    uint64_t state;             /* of the random numbers */
    char **lines;               /* of the examples, which are mutated */
    size_t line_count;
    size_t length;
    uint8_t text[NOISE_ROOM];   /* when full, further text is dropped */
} noise;

/* The examples' lines; false when a file cannot be read. */
bool noise_read(noise *n, const char *path);
void noise_free(noise *n);

/* A number below `limit`. */
unsigned noise_random(noise *n, unsigned limit);

/* Pieces, at the end of the text. */
void noise_bytes(noise *n, unsigned count);         /* any bytes */
void noise_tokens(noise *n, unsigned count);        /* the language's words, names, numbers and signs in any order */
void noise_statement(noise *n);                     /* a statement that the grammar allows */
void noise_program(noise *n, unsigned lines);       /* numbered statements */
void noise_example(noise *n, unsigned lines);       /* lines of the examples, some of them mutated */
void noise_command(noise *n);                       /* RUN, LIST, SAVE ... */
void noise_line_noise(noise *n, size_t from);       /* puts control characters and wrong bits into the text */

/* A line with its CR that stores nothing and loads nothing in any state of the board. */
void noise_harmless(noise *n);

#endif
