/* The command line of skg80 */
#ifndef OPTIONS_H
#define OPTIONS_H

#include "board.h"

enum { OPTIONS_BREAKS = 16 };

typedef struct {
    const char *part, *rom, *input, *punch, *tty, *tape, *com;
    const char *drive, *steps;
    const char *sym, *trace, *breaks[OPTIONS_BREAKS];
    unsigned break_count;
    unsigned ram_kib, baud;
    double mhz;                     /* 0: no real time */
    double feed;                    /* 0: full speed */
    double reader_cps, keyboard_cps; /* 0: characters wait for the board */
    int lag;                        /* of both, behind /RTS; negative: they ignore it */
    uint64_t max_cycles;
    uint64_t stop_at;               /* 0: never */
    board_kind kind;
    uint8_t tty_ports, aux_ports;   /* both 0: the board's own */
    bool pty, stats, punch_tty, punch_pty, debug;
    bool stop_stays, drives;        /* drives: one of the drive's options was given */
} options;

/* Fills `o`. Returns 0, or the exit code after a message; -1: done (--help). */
int options_read(int argc, char **argv, options *o);

#endif
