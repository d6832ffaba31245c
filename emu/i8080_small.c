/* The 8080 core for a microcontroller. See i8080_small.h for the programmer's view.
 *
 * One loop over the instruction table (i8080_ops.h), with nothing decoded beforehand and one test an instruction, that
 * of the slice's end. So whatever must be looked at before the next instruction (ports, EI, HLT) ends the slice.
 */
#include "i8080_small.h"

#include <string.h>

#define I8080_NARROW
#include "i8080_words.h"

enum { LONGEST = 3 };               /* bytes of an instruction */

/* S, Z and P of a result: as a constant it stays in flash. */
#define SZP_OF(v) [0x##v] = (0x##v & FLAG_S) | (0x##v ? 0 : FLAG_Z) | (__builtin_parity(0x##v) ? 0 : FLAG_P),
static const uint8_t szp[256] = { EVERY_OPCODE(SZP_OF) };

#define LENGTH_OF(op) [0x##op] = LENGTH(OP_##op),
static const uint8_t instruction_length[256] = { EVERY_OPCODE(LENGTH_OF) };

static const uint8_t nothing[I8080_SMALL_PAGE] = { [0 ... I8080_SMALL_PAGE - 1] = 0xff };

/* ---- memory; an address, PC too, may have run past FFFF ---- */

static unsigned page_of(reg address)
{
    return address / I8080_SMALL_PAGE % I8080_SMALL_PAGES;
}

static reg get(const i8080_small *c, reg address)
{
    return c->read[page_of(address)][address % I8080_SMALL_PAGE];
}

static reg get16(const i8080_small *c, reg address)
{
    return get(c, address) | get(c, address + 1) << 8;
}

static void put(i8080_small *c, reg address, reg value)
{
    uint8_t *page = c->write[page_of(address)];
    if (page) {
        page[address % I8080_SMALL_PAGE] = (uint8_t)value;
    }
}

static void put16(i8080_small *c, reg address, reg value)
{
    put(c, address, value & 0xff);
    put(c, address + 1, value >> 8);
}

/* Gives the bytes of the instruction at `address`, which may lie in two pages: then they are gathered in `gathered`. */
static const uint8_t *fetch(const i8080_small *c, reg address, uint8_t gathered[LONGEST])
{
    unsigned at = address % I8080_SMALL_PAGE;
    if (at <= I8080_SMALL_PAGE - LONGEST) {
        return c->read[page_of(address)] + at;
    }
    for (unsigned i = 0; i < LONGEST; i++) {
        gathered[i] = (uint8_t)get(c, address + i);
    }
    return gathered;
}

/* ---- the loop ---- */

#undef RD
#undef RD16
#undef SZP
#define RD(address) get(c, address)
#define RD16(address) get16(c, address)
#define SZP(v) (f = szp[v])
#define IMM8 ((reg)code[1])
#define IMM16 ((reg)(code[1] | code[2] << 8))
#define WR(address, value) put(c, address, value)
#define WR16(address, value) put16(c, address, value)
#define PUSH(value) (sp = (sp - 2) & 0xffff, put16(c, sp, value))
#define NEXT goto done
/* Leaves `left` so small that any instruction uses it up. */
#define END_SLICE (c->slice_end -= (uint64_t)(left >> COUNT_BITS), left &= COUNT_MASK)
#define IN (SAVE_REGISTERS, SAVE_COUNTS, a = c->in(c->user, (uint8_t)IMM8), END_SLICE)
#define OUT (SAVE_REGISTERS, SAVE_COUNTS, c->out(c->user, (uint8_t)IMM8, (uint8_t)a), END_SLICE)
#define EI (c->inte = c->shadow = true, END_SLICE)
#define DI (c->inte = false)
#define HLT (c->halted = true, END_SLICE)
#define BODY(length, cycles, ...)           \
    __VA_ARGS__;                            \
    pc += length;                           \
    left -= COST(cycles, 1);
#define ROW(row) BODY(row)
#define CASE(op)                            \
    case 0x##op:                            \
        ROW(OP_##op)                        \
        break;

/* Carries out instructions for at most that many cycles; `bus` is NULL, or the instruction that an interrupting device
 * has put on the bus. */
static void carry_out(i8080_small *c, uint64_t cycles, const uint8_t *bus)
{
    REGISTERS;
    tally left;
    uint8_t gathered[LONGEST];
    c->shadow = false;
    c->slice_end = c->cycles + cycles;
    COUNT_SLICE;
    LOAD_REGISTERS;
    if (bus) {
        pc -= instruction_length[bus[0]];   /* PC is not counted up while the bytes come from the device */
    }
    do {
        const uint8_t *code = bus ? bus : fetch(c, pc, gathered);
        switch (code[0]) {
            EVERY_OPCODE(CASE)
        }
    done:;
    } while (left >= 0);
    SAVE_COUNTS;
    SAVE_REGISTERS;
}

/* ---- the library's face ---- */

i8080_reason i8080_small_run(i8080_small *c, uint64_t cycles)
{
    uint64_t end = c->cycles + cycles;
    for (;;) {
        if (c->stop_wanted) {
            c->stop_wanted = false;
            return I8080_STOPPED;
        }
        if (c->cycles >= end) {
            return I8080_CYCLES;
        }
        uint64_t rest = end - c->cycles;
        if (c->irq && c->inte && !c->shadow) {
            c->irq = c->inte = c->halted = false;
            carry_out(c, 1, c->irq_code);
        } else if (c->halted) {
            return I8080_HALTED;
        } else {
            carry_out(c, c->shadow ? 1 : rest < SLICE ? rest : SLICE, NULL);
        }
    }
}

void i8080_small_init(i8080_small *c, i8080_in_fn *in, i8080_out_fn *out, void *user)
{
    memset(c, 0, sizeof *c);
    c->in = in;
    c->out = out;
    c->user = user;
    c->f = FLAG_ONE;
    i8080_small_map(c, 0, 0xffff, NULL, NULL);
}

void i8080_small_map(i8080_small *c, uint16_t first, uint16_t last, const uint8_t *read, uint8_t *write)
{
    for (unsigned page = page_of(first); page <= page_of(last); page++) {
        size_t at = (page - page_of(first)) * I8080_SMALL_PAGE;
        c->read[page] = read ? read + at : nothing;
        c->write[page] = write ? write + at : NULL;
    }
}

uint8_t i8080_small_peek(const i8080_small *c, uint16_t address)
{
    return (uint8_t)get(c, address);
}

void i8080_small_reset(i8080_small *c)
{
    c->pc = 0;
    c->inte = c->halted = c->shadow = c->stop_wanted = false;
}

void i8080_small_interrupt(i8080_small *c, const uint8_t code[3])
{
    memcpy(c->irq_code, code, sizeof c->irq_code);
    c->irq = true;
}

void i8080_small_interrupt_clear(i8080_small *c)
{
    c->irq = false;
}

void i8080_small_stop(i8080_small *c)
{
    c->stop_wanted = true;
}
