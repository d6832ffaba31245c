/* The command line of skg80 */
#ifndef OPTIONS_H
#define OPTIONS_H

#include "board.h"

enum { OPTIONS_BREAKS = 16 };

typedef struct {
    const char *part, *rom, *input, *punch, *tty, *tape, *com;
    const char *drive, *steps;      /* pictures and steps of the two motors */
    double feed_hz;                 /* 0: tied to the step output */
    uint64_t stop_at;
    const char *sym, *trace, *breaks[OPTIONS_BREAKS];
    unsigned break_count;
    unsigned ram_kib, baud;
    double mhz;                     /* 0: no time is kept */
    uint64_t max_cycles;
    board_kind kind;
    bool pty, stats, punch_tty, punch_pty, debug;
} options;

/* Fills `o`. Returns 0, or the exit code after a message; -1: all is said and done (--help). */
int options_read(int argc, char **argv, options *o);

#endif
