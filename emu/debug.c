/* The debugger's way of running the board. See debug.h. */
#include "debug_state.h"

#include "complain.h"
#include "terminal.h"
#include "trace.h"

#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>

/* ---- position ---- */

debug *debug_new(board *b, const symbols *names, FILE *trace, bool stopped)
{
    debug *d = calloc(1, sizeof *d);
    calculator *k = names ? malloc(sizeof *k) : NULL;
    if (!d || (names && !k)) {
        free(d);
        free(k);
        return NULL;
    }
    const char *missing = names ? calculator_init(k, names) : NULL;
    if (missing) {
        remark("no symbol %s in the .sym file: the calculator is not shown", missing);
        free(k);
        k = NULL;
    }
    *d = (debug){ .board = b, .names = names, .calculator = k, .trace = trace, .mode = stopped ? STOPPED : RUNS };
    return d;
}

void debug_free(debug *d)
{
    if (d) {
        free(d->calculator);
        free(d);
    }
}

bool debug_left(const debug *d)
{
    return d->left;
}

int debug_failure(debug *d)
{
    if (d->trace && (fflush(d->trace) || ferror(d->trace)) && !d->trace_failed) {
        d->trace_failed = errno ? errno : EIO;
    }
    return d->trace_failed;
}

void debug_stop(debug *d)
{
    d->mode = STOPPED;
}

/* Is the board at a breakpoint, in machine code or in byte-code? */
static bool at_break(const debug *d)
{
    const i8080 *c = &d->board->cpu;
    return breaks_has(&d->breaks, c->pc) || (trace_at_operation(c, d->calculator) && breaks_has(&d->breaks, c->bc));
}

bool debug_break(debug *d, const char *place)
{
    uint16_t address;
    return symbols_address(d->names, place, &address) && breaks_set(&d->breaks, address);
}

/* ---- running ---- */

static volatile sig_atomic_t interrupted;

static void on_interrupt(int number)
{
    (void)number;
    interrupted = 1;
}

void debug_catch_interrupt(void)
{
    terminal_catch_interrupt(on_interrupt);
}

/* Tells whether the board has reached the next stop of the present mode. */
static bool arrived(debug *d)
{
    const i8080 *c = &d->board->cpu;
    switch (d->mode) {
    case STEPS:
        return --d->count == 0;
    case OPERATES:
        return trace_at_operation(c, d->calculator) && --d->count == 0;
    case RETURNS:
        return c->sp > d->stack;
    default:
        return false;
    }
}

static board_reason one_instruction(debug *d)
{
    const i8080 *c = &d->board->cpu;
    if (d->trace) {
        if (trace_at_operation(c, d->calculator)) {
            trace_operation(c, d->calculator, d->trace);
        }
        trace_instruction(c, d->names, d->trace);
    }
    return board_run(d->board, 1);
}

/* Runs at full speed to a breakpoint in machine code, or to the calculator's next operation if there may be one in
 * byte-code. */
static board_reason run_free(debug *d, uint64_t cycles)
{
    i8080 *c = &d->board->cpu;
    breaks_arm(&d->breaks, c, true);
    if (d->breaks.count && d->calculator) {
        i8080_break(c, d->calculator->next, true);
    }
    board_reason reason = board_run(d->board, cycles);
    breaks_arm(&d->breaks, c, false);
    if (d->calculator) {
        i8080_break(c, d->calculator->next, false);
    }
    return reason;
}

board_reason debug_run(debug *d, uint64_t cycles)
{
    i8080 *c = &d->board->cpu;
    uint64_t end = c->cycles + cycles;
    while (c->cycles < end) {
        if (interrupted) {
            interrupted = 0;
            d->mode = STOPPED;
        }
        if (d->mode == STOPPED) {
            debug_talk(d);
            if (d->left) {
                return BOARD_CYCLES;
            }
        }
        /* One instruction alone, which may be the one at the last breakpoint; then as many as the mode allows. */
        board_reason reason = one_instruction(d);
        if (reason == BOARD_CYCLES && !at_break(d) && d->mode == RUNS && !d->trace && c->cycles < end) {
            reason = run_free(d, end - c->cycles);
            bool looks = breaks_has(&d->breaks, c->pc) || trace_at_operation(c, d->calculator);
            reason = reason == BOARD_BREAK && looks ? BOARD_CYCLES : reason;
        }
        if (arrived(d) || at_break(d)) {
            d->mode = STOPPED;
        }
        bool over = reason == BOARD_HALT || reason == BOARD_NOBODY || reason == BOARD_BREAK;
        if (reason != BOARD_CYCLES && (over || d->mode != STOPPED)) {
            return reason; /* (a board that waits for a key returns BOARD_WAIT again afterwards) */
        }
    }
    return BOARD_CYCLES;
}
