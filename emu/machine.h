/* The board for tests: the functions of build/libskg80.so that skg.board (Python, ctypes) calls
 *
 * A board that keeps its paper, its punch tape and its drive's steps in memory, and on which single subroutines of the ROM can be called,
 * one at a time or a million in a row. Functions give counts and reasons; all memory is the machine's own.
 *
 * NOT IMPLEMENTED: calls that start in the middle of a run (a call takes over PC and SP).
 */
#ifndef MACHINE_H
#define MACHINE_H

#include "board.h"

typedef struct machine machine;

/* The registers that go in and come out. */
typedef struct {
    uint8_t a, f;
    uint16_t bc, de, hl, sp, pc;
} machine_registers;

/* Counts; see i8080_watch and board for their meanings. */
typedef struct {
    uint64_t cycles, instructions, fetches_outside;
    uint32_t lowest_sp, first_outside, error_lines;
} machine_counts;

/* The end of a call. */
typedef enum {
    MACHINE_RETURNED,
    MACHINE_CYCLES,     /* still running after max_cycles */
    MACHINE_STOP,       /* reached one of the stop addresses */
    MACHINE_HALT,
    MACHINE_WAIT        /* waited for the operator */
} machine_end;

/* One subroutine, called for many records. */
typedef struct {
    machine_registers registers;    /* before every call; sp as well, pc = the subroutine */
    uint32_t max_cycles;            /* for one call */
    uint32_t in_length, out_length; /* bytes copied to in_address before and from out_address after every call */
    uint16_t in_address, out_address;
} machine_job;

machine *machine_new(const uint8_t *rom, size_t length, unsigned ram_kib, int kind, bool punch_tty, unsigned baud);
void machine_free(machine *m);

/* Other ports than the board's: the lower one of each pair. */
void machine_ports(machine *m, uint8_t tty, uint8_t aux);
board *machine_board(machine *m);

/* Typed characters (`typed`), or the tape, come at so many characters a second whether the board is ready or not, and
 * stop `lag` characters after /RTS has risen (negative: never). 0: they wait for the board. */
void machine_sender(machine *m, bool typed, double cps, int lag);

/* Characters lost at a full receiver. */
uint64_t machine_lost(const machine *m);

/* The drive: its feed clock (0: full speed), and when its stop line, which is down now, rises: at a
 * step counted since power-on (0: never). The count of hasty steps (drive.h). */
void machine_feed(machine *m, double hz);
void machine_stop_at(machine *m, uint64_t step, bool stays);
uint64_t machine_hasty_steps(const machine *m);

/* The present levels of its lines to the machine. */
uint8_t machine_drive(const machine *m);

/* The steps since the last machine_clear: the port's value, and the cycles at which the pulse rose. */
size_t machine_steps(const machine *m, const uint8_t **values, const uint64_t **cycles);

/* Everything printed (`punch` false) or punched since the last machine_clear. */
size_t machine_output(const machine *m, bool punch, const uint8_t **bytes);
void machine_clear(machine *m);

/* The port of the last BOARD_NOBODY, and whether a chip is there. */
uint8_t machine_nobody(const machine *m, bool *chip);

void machine_peek(const machine *m, uint16_t address, uint8_t *bytes, size_t length);
void machine_poke(machine *m, uint16_t address, const uint8_t *bytes, size_t length);
void machine_get(const machine *m, machine_registers *r);
void machine_set(machine *m, const machine_registers *r);
void machine_count(const machine *m, machine_counts *counts);
void machine_watch(machine *m, bool on, uint16_t first, uint16_t last);

/* Tells whether a translation of its ROM runs it (i8080_translate). */
bool machine_is_translated(const machine *m);

void machine_interrupt(machine *m, const uint8_t code[3]);
void machine_break(machine *m, uint16_t address, bool on);

/* Calls job->registers.pc for each of `count` records of job->in_length bytes at `in`, and gives job->out_length bytes at
 * `out`, the cycles, the end (machine_end) and, unless NULL, the registers of each. A call that reaches a breakpoint set
 * with machine_break ends there. Returns the number of calls that did not return. */
size_t machine_batch(machine *m, const machine_job *job, size_t count, const uint8_t *in, uint8_t *out,
                     uint32_t *cycles, uint8_t *ends, machine_registers *registers);

#endif
