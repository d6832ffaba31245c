/* A small debugger between the operator and the board: skg80 --debug, --break, --trace
 *
 * It runs the board instead of board_run, stops at breakpoints, and then talks: commands come from standard input,
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
 * instruction. NULL without memory. The debugger keeps both. */
debug *debug_new(board *b, const symbols *names, FILE *trace, bool stopped);
void debug_free(debug *d);

/* Sets a breakpoint; false when there are too many of them, or no such place. */
bool debug_break(debug *d, const char *place);

/* As board_run, but stops at breakpoints and talks there. */
board_reason debug_run(debug *d, uint64_t cycles);

/* Stops at the next instruction, to talk. */
void debug_stop(debug *d);

/* From now on the signal INT does the same. */
void debug_catch_interrupt(void);

/* Has the operator said `quit`, or has the input ended? */
bool debug_left(const debug *d);

/* Writes the trace to its file: 0, or the errno of a failure. */
int debug_failure(debug *d);

#endif
