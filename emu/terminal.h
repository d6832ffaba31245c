/* The operator's side of the teletype: this terminal, a pipe, or a pseudo-terminal; the machine's side of the punch, which
 * may be one too; and real time
 *
 * A terminal is switched to raw mode and put back on exit and on every signal that ends or stops the program. ctrl-]
 * leaves, ctrl-\ is the reset button. ctrl-C, ctrl-S and ctrl-Q reach the board at once, ctrl-C drops characters typed
 * ahead; everything else is typed when the board asks for it. From a pipe all characters are typed in their order, and
 * LF is CR. A character without an ASCII sign (signs.h) drops its line: ctrl-U takes back what the board has of it, and
 * the rest is not typed, up to its end, ctrl-U or ctrl-C. The signal USR1 is the reset button too, with terminal, pipe and pseudo-terminal.
 *
 * The systems' own parts are terminal_posix.c and terminal_windows.c.
 *
 * NOT IMPLEMENTED: the modem lines, break and speed of a pseudo-terminal; more than one user of it; on Windows
 * pseudo-terminals and the signal USR1.
 */
#ifndef TERMINAL_H
#define TERMINAL_H

#include "board.h"

#include <stdio.h>

typedef struct {
    int in, out; /* file descriptors */
    int line; /* of a pseudo-terminal, the end that its user has too */
    bool keyboard; /* a person or a program at a line (not a pipe): keys, not text */
    bool leaves; /* ctrl-] leaves, ctrl-\ resets */
    bool ended; /* no more will come, or ctrl-] */
    bool left; /* ctrl-] */
    bool reset; /* ctrl-\ or USR1; cleared by the caller that handles it */
    bool stop; /* ctrl-^, with a debugger; likewise */
    bool stops; /* there is a debugger */
    int failed; /* errno of a character that could not be printed; 0: none */
    int patience; /* ms that a full pseudo-terminal may keep the board waiting */
    bool deaf; /* nobody reads the pseudo-terminal */
    bool after_cr;
    uint8_t character[4]; /* in UTF-8, begun */
    size_t character_length;
    unsigned row, column; /* of a pipe, lines that have ended; signs typed in the present one */
    bool dropped; /* the rest of the present line is not typed */
    bool refused; /* a line was dropped */
    FILE *copy; /* of all that is printed; NULL: none */
    char name[64]; /* of the pseudo-terminal */
} terminal;

/* Real time at `hz`; hz = 0: no time at all. */
typedef struct {
    double hz;
    uint64_t start_cycles;
    double start; /* s */
} pacer;

/* Opens closed standard streams and makes all three binary; call it before any file is opened. False on failure. */
bool terminal_open_streams(void);

/* Takes standard input and output; raw mode when the input is a terminal. */
void terminal_open(terminal *t);

/* Makes a pseudo-terminal and its name; 0, or -1 with errno. */
int terminal_open_pty(terminal *t);

/* Takes the signal USR1 for the reset button from now on. */
void terminal_catch_reset(void);

/* Has a function called at the signal INT, which then does nothing else. */
void terminal_catch_interrupt(void (*called)(int));

/* Leaves raw mode, so that lines can be typed; true when it was on. terminal_resume goes back to it. */
bool terminal_pause(void);
void terminal_resume(void);

/* Is the terminal in raw mode now? A line must then end in CR LF. */
bool terminal_is_raw(void);

/* Prints one character of the paper. */
void terminal_print(terminal *t, uint8_t c);

/* Handles a byte of a key, or from a pipe: the board gets it, or it leaves, resets or stops. False without memory. */
bool terminal_take(terminal *t, board *b, uint8_t c);

/* Waits up to so many milliseconds (-1: for ever) for keys and gives them to the board; a reset ends the waiting. False
 * without memory. */
bool terminal_listen(terminal *t, board *b, int milliseconds);

/* Waits up to so many milliseconds (-1: for ever) for a machine's characters, at the pseudo-terminal of punch and
 * reader, and puts them into the reader. False without memory. */
bool terminal_feed(terminal *t, board *b, int milliseconds);

/* Waits until the other end has read all output at a pseudo-terminal; after `patience` ms it counts as deaf. */
void terminal_drain(terminal *t);

/* Starts real time now, and sleeps until the processor's cycles are due. */
void pacer_start(pacer *p, double hz, uint64_t cycles);
void pacer_wait(const pacer *p, uint64_t cycles);

/* Seconds since some moment; sleeps. */
double terminal_now(void);
void terminal_sleep(double seconds);

#endif
