/* A file that a run writes: what was under its name before is there until there is something whole to take its place
 *
 * What is written goes to NAME.part beside NAME, which takes NAME's place when it is kept, and what is written later is
 * added to it. What is no plain file, a printer for one, gets the bytes as they come.
 */
#ifndef OUTFILE_H
#define OUTFILE_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#define OUTFILE_PART ".part"

enum { TAPE_END = 3 };          /* characters before the end of a tape's last line: M30, or DD alone on it */

typedef struct {
    FILE *file;                 /* NULL: nothing is written */
    char *name, *part;          /* links followed; no part: it is no plain file */
    bool kept;                  /* it has its name */
    char end[TAPE_END];         /* of a tape: what was punched last */
} outfile;

/* Begins a file; false: it cannot be written, as errno says. */
bool outfile_open(outfile *f, const char *name);

/* Gives it its name, for all that is in it; false: as errno says. */
bool outfile_keep(outfile *f);

/* Begins it anew, beside the one that has the name by now; false: as errno says. */
bool outfile_again(outfile *f);

/* Of a tape: takes a byte that was written to it. It is kept when a line DD, one that ends in M30, or a program's ctrl-Z
 * has come. False: as errno says. */
bool outfile_punched(outfile *f, uint8_t byte);

/* Ends it as it is: an empty part goes. `left` becomes the name of a part that is left, or NULL. False: not all that was
 * written is in it, as errno says. */
bool outfile_leave(outfile *f, const char **left);

#endif
