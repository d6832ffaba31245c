/* Intel 8080A core. See i8080.h for the programmer's view.
 *
 * Two loops carry out the same table of instructions (i8080_ops.h, its words in i8080_words.h):
 *
 * - run_fast keeps the registers in locals and jumps from handler to handler through code[], which holds one
 *   handler address for every memory address. Most addresses start as `undecoded`; decode() puts in the handler
 *   for the opcode found there. Operands are not decoded but read when they are needed.
 * - run_careful does one instruction after the other from memory and has everything that is rare: ports, EI and DI,
 *   HLT, writes to anything but plain RAM, breakpoints, watching. The fast loop leaves to it every
 *   instruction that touches one of these, before that instruction has changed anything.
 *
 * A program in ROM that was translated beforehand (i8080_translated.c) is a third one: the fast loop calls it wherever PC
 * comes to one of its entries, and goes on where it comes back.
 *
 * mark[] says of each byte what a write to it must not overlook: read-only, decoded as an opcode (the write
 * must undo that), breakpoint, mirrored, translated. Zero is plain RAM, and one test of it is all that a fast write costs.
 */
#include "i8080.h"
#include "i8080_words.h"

#include <string.h>

enum {
    MARK_NOT_RAM = 1,
    MARK_OPEN = 2,
    MARK_CODE = 4,
    MARK_BREAK = 8,
    MARK_MIRROR = 16,
    MARK_TRANSLATED = 32,
    MARK_ENTRY = 64             /* of the translation */
};

enum { MIRRORED = 4 };          /* bytes at 0000 that are kept a second time past FFFF */

/* Places in the table of the fast loop's handlers; below these, the opcodes. */
enum {
    HANDLE_UNDECODED = 256,     /* look at the opcode first */
    HANDLE_CAREFUL,             /* leave the instruction to run_careful */
    HANDLE_WRAP,                /* PC has run past FFFF */
    HANDLE_TRANSLATED,          /* an entry of the translation */
    HANDLERS
};

/* ---- memory ---- */

/* All that was decoded is forgotten. */
static void forget_all(i8080 *c)
{
    for (unsigned i = 0; i < I8080_SPACE + I8080_PAD; i++) {
        c->code[i] = c->handlers[i < I8080_SPACE ? HANDLE_UNDECODED : HANDLE_WRAP];
    }
}

static void end_translation(i8080 *c)
{
    for (unsigned i = 0; i < I8080_SPACE; i++) {
        c->mark[i] &= (uint8_t)~(MARK_TRANSLATED | MARK_ENTRY);
    }
    c->translation = NULL;
    forget_all(c);
}

static void forget_code(i8080 *c, unsigned address)
{
    if (c->mark[address] & MARK_TRANSLATED) {
        end_translation(c);
    }
    c->code[address] = c->handlers[HANDLE_UNDECODED];
    c->mark[address] &= (uint8_t)~MARK_CODE;
}

static void set_byte(i8080 *c, unsigned address, uint8_t value)
{
    c->mem[address] = value;
    if (address < MIRRORED) {
        c->mem[I8080_SPACE + address] = value;
    }
    if (c->mark[address] & (MARK_CODE | MARK_TRANSLATED)) {
        forget_code(c, address);
    }
}

void i8080_map(i8080 *c, uint16_t first, uint16_t last, i8080_kind kind)
{
    for (unsigned i = first; i <= last; i++) {
        if (c->mark[i] & MARK_TRANSLATED) {
            end_translation(c);
        }
        uint8_t mark = c->mark[i] & (MARK_CODE | MARK_BREAK | MARK_MIRROR);
        if (kind == I8080_OPEN) {
            set_byte(c, i, 0xff);
            mark |= MARK_NOT_RAM | MARK_OPEN;
        } else if (kind == I8080_ROM) {
            mark |= MARK_NOT_RAM;
        }
        c->mark[i] = mark;
    }
}

uint8_t i8080_peek(const i8080 *c, uint16_t address)
{
    return c->mem[address];
}

void i8080_poke(i8080 *c, uint16_t address, uint8_t value)
{
    if (!(c->mark[address] & MARK_OPEN)) {
        set_byte(c, address, value);
    }
}

bool i8080_fetched(const i8080 *c, uint16_t address)
{
    return c->code[address] != c->handlers[HANDLE_UNDECODED];
}

void i8080_break(i8080 *c, uint16_t address, bool on)
{
    forget_code(c, address);
    if (on) {
        c->mark[address] |= MARK_BREAK;
    } else {
        c->mark[address] &= (uint8_t)~MARK_BREAK;
    }
}

/* ---- the careful loop ---- */

static void store(i8080 *c, reg address, reg value)
{
    unsigned at = address & 0xffff;
    uint8_t mark = c->mark[at];
    if (mark & MARK_NOT_RAM) {
        if (!(mark & MARK_OPEN)) {
            c->rom_writes++;
            c->rom_written = (uint16_t)at;
        }
        return;
    }
    if (c->watching && c->written) {
        c->written[at] = 1;
    }
    if (mark) {
        set_byte(c, at, (uint8_t)value);
    } else {
        c->mem[at] = (uint8_t)value;
    }
}

/* Something that run_careful's caller must look at before the next instruction. */
static bool attention(const i8080 *c)
{
    return c->stop_wanted || c->halted || c->shadow || (c->irq && c->inte);
}

#define LENGTH_OF(op) [0x##op] = LENGTH(OP_##op),
static const uint8_t instruction_length[256] = { EVERY_OPCODE(LENGTH_OF) };

/* Carries out instructions until the slice is over or attention() is due; `bus` is NULL, or the instruction that an
 * interrupting device has put on the bus, which is then the only one. `single`: one instruction in any case.
 * True when it stands at a breakpoint. */
static bool run_careful(i8080 *c, const uint8_t *bus, bool single)
{
#define IMM8 ((reg)code[1])
#define IMM16 ((reg)(code[1] | code[2] << 8))
#define WR(address, value) store(c, address, value)
#define WR16(address, value)                                                        \
    do {                                                                            \
        reg at_ = (address); /* (once: SHLD may write onto its own operand) */      \
        store(c, at_, (value) & 0xff);                                              \
        store(c, at_ + 1, (value) >> 8);                                            \
    } while (0)
#define PUSH(value)                                                                 \
    do {                                                                            \
        reg v_ = (value);                                                           \
        sp = (sp - 2) & 0xffff;                                                     \
        store(c, sp + 1, v_ >> 8);                                                  \
        store(c, sp, v_ & 0xff);                                                    \
        if (c->watching && sp < c->lowest_sp) {                                     \
            c->lowest_sp = (uint16_t)sp;                                            \
        }                                                                           \
    } while (0)
#define NEXT goto done
#define IN (SAVE_REGISTERS, SAVE_COUNTS, a = c->in(c->user, (uint8_t)IMM8))
#define OUT (SAVE_REGISTERS, SAVE_COUNTS, c->out(c->user, (uint8_t)IMM8, (uint8_t)a))
#define EI (c->inte = c->shadow = true)
#define DI (c->inte = false)
#define HLT (c->halted = true)
#define BODY(length, cycles, ...)           \
    __VA_ARGS__;                            \
    pc += length;                           \
    left -= COST(cycles, 1);
#define ROW(row) BODY(row)
#define CASE(op)                            \
    case 0x##op:                            \
        ROW(OP_##op)                        \
        break;

    REGISTERS;
    bool at_break = false;
    tally left;
    COUNT_SLICE;
    LOAD_REGISTERS;
    do {
        const uint8_t *code = bus ? bus : c->mem + pc;
        if (UNLIKELY(c->mark[pc] & MARK_BREAK) && !bus) {
            at_break = true;
            break;
        }
        if (c->watching && !bus && (pc < c->fetch_first || pc > c->fetch_last)) {
            if (!c->fetches_outside++) {
                c->first_outside = (uint16_t)pc;
            }
        }
        c->shadow = false;
        if (bus) {
            pc -= instruction_length[code[0]];  /* PC is not counted up while the bytes come from the device */
        }
        switch (code[0]) {
            EVERY_OPCODE(CASE)
        }
    done:
        pc &= 0xffff;
    } while (!single && left >= 0 && !attention(c));
    SAVE_COUNTS;
    SAVE_REGISTERS;
    return at_break;
}

#undef IMM8
#undef IMM16
#undef WR
#undef WR16
#undef PUSH
#undef NEXT
#undef IN
#undef OUT
#undef EI
#undef DI
#undef HLT
#undef CASE

/* ---- the fast loop ---- */

/* The handler for what is at `address`; marks its opcode. */
static unsigned decode(i8080 *c, unsigned address)
{
    uint8_t opcode = c->mem[address];
    if (c->mark[address] & MARK_BREAK) {
        return HANDLE_CAREFUL;
    }
    if (c->mark[address] & MARK_ENTRY) {
        return HANDLE_TRANSLATED;
    }
    c->mark[address] |= MARK_CODE;
    return opcode;
}

#define IMM8 RD(pc + 1)
#define IMM16 RD16(pc + 1)
#define NEXT                                \
    do {                                    \
        if (UNLIKELY(left < 0)) {           \
            goto leave;                     \
        }                                   \
        goto *c->code[pc];                  \
    } while (0)
#include "i8080_fast.h"

/* Runs until the slice is over or attention() is due; true when it stands at a breakpoint. With `labels` it only
 * gives away the table of its handlers. */
static bool run_fast(i8080 *c, bool labels)
{
    static const void *const handlers[HANDLERS] = {
#define LABEL(op) [0x##op] = &&op_##op,
        EVERY_OPCODE(LABEL)
        [HANDLE_UNDECODED] = &&undecoded,
        [HANDLE_CAREFUL] = &&careful,
        [HANDLE_WRAP] = &&wrap,
        [HANDLE_TRANSLATED] = &&translated,
    };

    REGISTERS;
    tally left;

    if (labels) {
        c->handlers = handlers;
        return false;
    }
    LOAD_REGISTERS;
    COUNT_SLICE;
    NEXT;

#define HANDLER(op)                         \
    op_##op:                                \
    ROW(OP_##op)                            \
    NEXT;
    EVERY_OPCODE(HANDLER)

wrap:
    pc &= 0xffff;
    NEXT;

undecoded:
    c->code[pc] = handlers[decode(c, (unsigned)pc)];
    goto *c->code[pc];

translated:
    SAVE_COUNTS;
    SAVE_REGISTERS;
    c->translation->run(c);
    LOAD_REGISTERS;
    COUNT_SLICE;
    if (UNLIKELY(left < 0 || attention(c))) {
        goto leave;
    }
    if (c->code[pc] == handlers[HANDLE_TRANSLATED]) {
        goto *handlers[c->mem[pc]];         /* back from an entry at once: it goes on with the instruction behind it */
    }
    goto *c->code[pc];

careful:
    SAVE_COUNTS;
    SAVE_REGISTERS;
    if (run_careful(c, NULL, true)) {
        return true;
    }
    if (attention(c) || c->cycles >= c->slice_end) {
        return false;
    }
    LOAD_REGISTERS;
    COUNT_SLICE;
    NEXT;

leave:
    pc &= 0xffff;
    SAVE_COUNTS;
    SAVE_REGISTERS;
    return false;
}

/* ---- the library's face ---- */

i8080_reason i8080_run(i8080 *c, uint64_t cycles)
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
        bool at_break;
        if (c->irq && c->inte && !c->shadow) {
            uint8_t code[3];
            memcpy(code, c->irq_code, sizeof code);
            c->irq = c->inte = c->halted = false;
            c->slice_end = c->cycles + 1;
            at_break = run_careful(c, code, true);
        } else if (c->halted) {
            return I8080_HALTED;
        } else {
            c->slice_end = c->cycles + (rest < SLICE ? rest : SLICE);
            at_break = c->watching || c->shadow ? run_careful(c, NULL, c->shadow) : run_fast(c, false);
        }
        if (at_break) {
            return I8080_BREAK;
        }
    }
}

void i8080_init(i8080 *c, i8080_in_fn *in, i8080_out_fn *out, void *user)
{
    memset(c, 0, sizeof *c);
    c->in = in;
    c->out = out;
    c->user = user;
    c->f = FLAG_ONE;
    c->lowest_sp = 0xffff;
    for (unsigned v = 0; v < 256; v++) {
        bool even = !__builtin_parity(v);
        c->szp[v] = (uint8_t)((v & FLAG_S) | (v ? 0 : FLAG_Z) | (even ? FLAG_P : 0));
    }
    run_fast(c, true);
    forget_all(c);
    for (unsigned i = 0; i < MIRRORED; i++) {
        c->mark[i] = c->mark[I8080_SPACE + i] = MARK_MIRROR;
    }
}

bool i8080_translate(i8080 *c, const i8080_translation *t)
{
    for (size_t i = 0; i < t->count; i++) {
        const i8080_instruction *one = &t->instructions[i];
        for (unsigned k = 0; k < one->length; k++) {
            unsigned at = (one->address + k) & 0xffff;
            if (c->mem[at] != one->bytes[k] || !(c->mark[at] & MARK_NOT_RAM) || (c->mark[at] & MARK_BREAK)) {
                return false;
            }
        }
    }
    end_translation(c);                     /* of another one */
    c->translation = t;
    for (size_t i = 0; i < t->count; i++) {
        const i8080_instruction *one = &t->instructions[i];
        for (unsigned k = 0; k < one->length; k++) {
            c->mark[(one->address + k) & 0xffff] |= MARK_TRANSLATED;
        }
        if (one->entry) {
            c->mark[one->address] |= MARK_ENTRY;
        }
    }
    return true;
}

void i8080_reset(i8080 *c)
{
    c->pc = 0;
    c->inte = c->halted = c->shadow = c->stop_wanted = false;
}

void i8080_interrupt(i8080 *c, const uint8_t code[3])
{
    memcpy(c->irq_code, code, sizeof c->irq_code);
    c->irq = true;
}

void i8080_interrupt_clear(i8080 *c)
{
    c->irq = false;
}

void i8080_stop(i8080 *c)
{
    c->stop_wanted = true;
}

void i8080_watch(i8080 *c, bool on, uint16_t first, uint16_t last)
{
    c->watching = on;
    if (on) {
        c->lowest_sp = 0xffff;
        c->fetch_first = first;
        c->fetch_last = last;
        c->fetches_outside = 0;
        c->first_outside = 0;
    }
}
