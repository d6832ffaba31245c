/* A small debugger between the operator and the board: skg80 --debug, --break, --trace
 *
 * It runs the board instead of board_run, stops where it was told to, and then talks: commands come from standard input,
 * answers go to standard error. `help` lists the commands. The board knows nothing of it.
 *
 * NOT IMPLEMENTED: breakpoints on data; going back; changing registers or memory.
 */
#ifndef DEBUG_H
#define DEBUG_H

#include "board.h"
#include "symbols.h"

#include <stdio.h>

typedef struct debug debug;

/* `names` may be NULL; `trace`: a file for all instructions, or NULL. With `stopped` it talks before the first
 * instruction. NULL without memory. The debugger keeps `names` and closes `trace`. */
debug *debug_new(board *b, const symbols *names, FILE *trace, bool stopped);
void debug_free(debug *d);

/* Sets a breakpoint; false when there are too many of them, or no such place. */
bool debug_break(debug *d, const char *place);

/* As board_run, but stops at breakpoints and talks there. */
board_reason debug_run(debug *d, uint64_t cycles);

/* The operator wants to talk: at the next instruction. */
void debug_stop(debug *d);

/* Takes the signal INT for that wish from now on. */
void debug_catch_interrupt(void);

/* Has the operator said `quit`, or has the input ended? */
bool debug_left(const debug *d);

/* Writes out what there is of a trace: the errno when that cannot be done, else 0. */
int debug_failure(debug *d);

#endif
