/* A program in ROM as C: its i8080_translation is called NAME, and ROWS is the file that translate.c has written of it.
 *
 * A row is an instruction with its operand; the table (i8080_ops.h) says what it does. The compiler sees which flags
 * are never read, and where a jump goes. Rows stand in blocks, which are entered at their tops alone:
 *
 *      BLOCK(at, cycles, count)                                a block of so many instructions begins; an entry
 *      STEP(at, length, op, operand, cycles, count)            an instruction; cycles and count: of the block, from it on
 *      LEAP(at, length, op, operand, cycles, count)            the same of one whose operand is another block
 *      ON_TO(at)                                               the block is over, and goes on with that one
 *      ELSEWHERE(at)                                           what there is at an address was not translated
 *
 * A block is charged at entry, as if no jump were taken; an early exit refunds the rest. A block that may outlast the slice is
 * not entered. Before rare instructions, and before what was not translated, run() returns to the fast loop.
 */
#include "i8080.h"
#include "i8080_words.h"

#define IMM8 operand
#define IMM16 operand
#include "i8080_fast.h"

/* Control is transferred: the block's cycles from this instruction on are given back but for those that it took. */
#undef GO
#define GO(to, cycles)                      \
    do {                                    \
        pc = (to);                          \
        left += rest - COST(cycles, 1);     \
        goto away;                          \
    } while (0)

/* A port sees the counts at the instruction's start. If the port stops the run or raises an interrupt, leave the block
 * after this instruction. */
#undef IN
#undef OUT
#define PORT(access)                        \
    do {                                    \
        left += rest;                       \
        SAVE_COUNTS;                        \
        SAVE_REGISTERS;                     \
        access;                             \
        if (UNLIKELY(c->stop_wanted || c->irq)) {   \
            pc += 2;                        \
            left -= COST(10, 1);            \
            goto out;                       \
        }                                   \
        left -= rest;                       \
    } while (0)
#define IN PORT(a = c->in(c->user, (uint8_t)IMM8))
#define OUT PORT(c->out(c->user, (uint8_t)IMM8, (uint8_t)a))

#define BODY(length, cycles, ...) __VA_ARGS__;
#define CARRY_OUT(row) BODY(row)

/* The rows as what must stand in memory. */
#define BLOCK(at, cycles, count) { 0x##at, 0, { 0 }, true },
#define STEP(at, size, op, value, cycles, count) { 0x##at, size, { 0x##op, 0x##value & 0xff, 0x##value >> 8 }, false },
#define LEAP STEP
#define ON_TO(at)
#define ELSEWHERE(at)
static const i8080_instruction instructions[] = {
#include ROWS
};
#undef BLOCK
#undef STEP
#undef ON_TO
#undef ELSEWHERE
#undef LEAP

enum { ENTRIES = 0x2000 };      /* no block begins at or above */

static void run(i8080 *c)
{
    static const void *const entries[ENTRIES] = {
#define BLOCK(at, cycles, count) [0x##at] = &&at_##at,
#define STEP(at, length, op, operand, cycles, count)
#define LEAP STEP
#define ON_TO(at)
#define ELSEWHERE(at)
#include ROWS
#undef BLOCK
#undef STEP
#undef LEAP
#undef ON_TO
#undef ELSEWHERE
    };

    REGISTERS;
    tally left, rest;
    reg operand;
    LOAD_REGISTERS;
    COUNT_SLICE;

dispatch:
    if (pc >= ENTRIES || !entries[pc]) {
        goto out;
    }
    goto *entries[pc];

#define BLOCK(at, cycles, count)            \
    at_##at:                                \
    if (UNLIKELY(left < COST(cycles, 0))) { \
        pc = 0x##at;                        \
        goto out;                           \
    }                                       \
    left -= COST(cycles, count);
/* (no `goto *` in each row: a compiler may take minutes for a thousand that go to a thousand places) */
#define ROW(at, op, value, cycles, count, to)   \
    {                                       \
        __label__ away;                     \
        pc = 0x##at;                        \
        operand = 0x##value;                \
        rest = COST(cycles, count);         \
        CARRY_OUT(OP_##op)                  \
        if (0) {                            \
        away:                               \
            __attribute__((unused));        \
            goto to;                        \
        }                                   \
    }
#define STEP(at, length, op, value, cycles, count) ROW(at, op, value, cycles, count, dispatch)
#define LEAP(at, length, op, value, cycles, count) ROW(at, op, value, cycles, count, at_##value)
#define ON_TO(at) goto at_##at;
#define ELSEWHERE(at)                       \
    at_##at:                                \
    pc = 0x##at;                            \
    goto out;
#include ROWS

careful:
    left += rest;
out:
    SAVE_COUNTS;
    SAVE_REGISTERS;
}

const i8080_translation NAME = { instructions, sizeof instructions / sizeof *instructions, run };
