/* One run of skg80: everything that it holds open
 *
 * `main` sets it up, `output` takes what the board prints, punches and steps, `operator` does the operator's work.
 */
#ifndef SESSION_H
#define SESSION_H

#include "board.h"
#include "debug.h"
#include "drawn.h"
#include "options.h"
#include "outfile.h"
#include "symbols.h"
#include "terminal.h"

#include <stdio.h>

enum {
    ERROR_LINE = 16                 /* characters of the longest line with ERR: a line number has 4 */
};

typedef struct {
    options o;
    board *board;
    debug *debug;                   /* NULL: none */
    symbols *names;
    terminal terminal;
    terminal line;                  /* the machine's, with --punch-pty */
    bool running;                   /* the part has been loaded and RUN or END typed */
    pacer pacer;
    FILE *paper, *punch;            /* NULL: nowhere */
    outfile tape, tty, steps, trace;    /* those of the options */
    outfile picture;                /* of the drive */
    drawn *drawn;                   /* its lines, */
    uint64_t steps_drawn;           /* and the steps in the file so far */
    bool began;                     /* the board has been run */
    bool punched_nowhere;           /* bytes were punched and are lost */
    uint64_t printed;               /* characters on the paper */
    char printing[ERROR_LINE + 1];  /* the beginning of its present line */
    size_t line_length;             /* and that line's length */
    bool below_error;               /* the line above is one with ERR */
    bool refused;                   /* the board answered something with ERR */
    const char *rest;               /* the line to type behind the loaded part; NULL: none */
    int failed;                     /* errno of output that was lost; 0: none */
    bool prompted;                  /* the machine has come to its first prompt */
    uint8_t written[I8080_SPACE];   /* since then (--stats) */
} session;

#endif
