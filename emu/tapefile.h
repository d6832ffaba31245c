/* The file of a punched tape: it has its name when the tape has its end
 *
 * What is punched goes to NAME.part beside NAME, until a line DD, one that ends in M30, or a program's ctrl-Z has come;
 * what was under the name is there until then. A tape that is punched behind that one is added to it. What is no plain file, a printer for
 * one, gets the bytes as they come.
 */
#ifndef TAPEFILE_H
#define TAPEFILE_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

enum { TAPE_END = 3 };          /* characters before the end of a tape's last line: M30, or DD alone on it */

typedef struct {
    char *name, *part;          /* those of the file, links followed; no part: it is no plain file */
    bool named;                 /* the tape has its name */
    char end[TAPE_END];         /* what was punched last */
} tapefile;

/* Begins a tape; NULL: it cannot be written, as errno says. */
FILE *tapefile_open(tapefile *t, const char *name);

/* Takes a byte that was written to the file, which may be another one then; NULL: as errno says. */
FILE *tapefile_follow(tapefile *t, FILE *file, uint8_t byte);

/* Ends it: an empty part goes. The name of a part that is left, or NULL. */
const char *tapefile_close(tapefile *t, FILE *file);

#endif
