/* Intel 8080A core. See i8080.h for the programmer's view.
 *
 * Two loops carry out the same table of instructions (i8080_ops.h):
 *
 * - run_fast keeps the registers in locals and jumps from handler to handler through code[], which holds one
 *   handler address for every memory address. Most addresses start as `undecoded`; decode() puts in the handler
 *   for the opcode found there, or one for a chain of two or three instructions (i8080_chains.h) that begins
 *   there. A chain saves the jumps between its handlers and nothing else: after each of its instructions it may be left,
 *   because the slice is over or the next one needs care. Operands are not decoded but read when they are needed.
 * - run_careful does one instruction after the other from memory and has everything that is rare: ports, EI and DI,
 *   HLT, writes to anything but plain RAM, breakpoints, watching. The fast loop leaves to it every
 *   instruction that touches one of these, before that instruction has changed anything.
 *
 * mark[] says of each byte what a write to it must not overlook: read-only, decoded as an opcode (the write
 * must undo that), breakpoint, mirrored. Zero is plain RAM, and one test of it is all that a fast write costs.
 *
 * The fast loop counts cycles and instructions in one number, `left`: cycles left in the slice times 2^24, plus
 * the instructions done. One subtraction an instruction, and the sign says when the slice is over.
 */
#include "i8080.h"
#include "i8080_chains.h"
#include "i8080_ops.h"

#include <string.h>

enum { MARK_NOT_RAM = 1, MARK_OPEN = 2, MARK_CODE = 4, MARK_BREAK = 8, MARK_MIRROR = 16 };

enum {
    CHAIN_SPAN = 7,         /* a chain's last opcode is less than so many bytes behind its first */
    MIRRORED = 4,           /* bytes at 0000 that are kept a second time past FFFF */
    SLICE = 1 << 25         /* cycles; less than 4 * 2^24, so that instructions never overflow their 24 bits */
};

/* Places in the table of the fast loop's handlers; below these, the opcodes. */
enum {
    HANDLE_UNDECODED = 256,     /* look at the opcode first */
    HANDLE_CAREFUL,             /* leave the instruction to run_careful */
    HANDLE_WRAP,                /* PC has run past FFFF */
    HANDLE_CHAINS               /* then the chains in their order */
};

#define CHAIN2(p, q) { 2, { 0x##p, 0x##q, 0 } },
#define CHAIN3(p, q, r) { 3, { 0x##p, 0x##q, 0x##r } },
static const struct {
    uint8_t length, opcode[3];
} chains[] = { EVERY_CHAIN(CHAIN2, CHAIN3) };
#undef CHAIN2
#undef CHAIN3

enum { CHAINS = sizeof chains / sizeof *chains };
_Static_assert(CHAINS <= 256, "first_chain[] has bytes");

#define UNLIKELY(x) __builtin_expect(!!(x), 0)

/* ---- memory ---- */

static void forget_code(i8080 *c, unsigned address)
{
    for (unsigned k = 0; k < CHAIN_SPAN; k++) {
        c->code[(address - k) & 0xffff] = c->handlers[HANDLE_UNDECODED];
    }
    c->mark[address] &= (uint8_t)~MARK_CODE;
}

static void set_byte(i8080 *c, unsigned address, uint8_t value)
{
    c->mem[address] = value;
    if (address < MIRRORED) {
        c->mem[I8080_SPACE + address] = value;
    }
    if (c->mark[address] & MARK_CODE) {
        forget_code(c, address);
    }
}

void i8080_map(i8080 *c, uint16_t first, uint16_t last, i8080_kind kind)
{
    for (unsigned i = first; i <= last; i++) {
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

/* ---- registers in locals, and what the table's words mean in both loops ---- */

/* f holds S, Z and P in their places, cy is 0 or 1, bit 4 of ac is AC; other bits of f and ac are noise. */
#define REGISTERS uint64_t a, f, cy, ac, bc, de, hl, sp, pc
#define LOAD_REGISTERS                                                                              \
    (a = c->a, f = c->f, cy = c->f & 1, ac = c->f, bc = c->bc, de = c->de, hl = c->hl, sp = c->sp,  \
     pc = c->pc)
#define SAVE_REGISTERS                                                                              \
    (c->a = (uint8_t)a, c->f = (uint8_t)GET_F, c->bc = (uint16_t)bc, c->de = (uint16_t)de,          \
     c->hl = (uint16_t)hl, c->sp = (uint16_t)sp, c->pc = (uint16_t)pc)

/* cycles and instructions as one number to subtract from `left` */
#define COST(cycles, instructions) (((int64_t)(cycles) << 24) - (instructions))

enum { FLAG_S = 0x80, FLAG_Z = 0x40, FLAG_AC = 0x10, FLAG_P = 0x04, FLAG_ONE = 0x02, FLAG_CY = 0x01 };

#define GET_F ((f & (FLAG_S | FLAG_Z | FLAG_P)) | (ac & FLAG_AC) | FLAG_ONE | cy)
#define S (f & FLAG_S)
#define Z (f & FLAG_Z)
#define PE (f & FLAG_P)
#define PO (!PE)
#define CY (cy != 0)

#define GET_A a
#define GET_B (bc >> 8)
#define GET_C (bc & 0xff)
#define GET_D (de >> 8)
#define GET_E (de & 0xff)
#define GET_H (hl >> 8)
#define GET_L (hl & 0xff)
#define GET_M RD(hl)
#define GET_BC bc
#define GET_DE de
#define GET_HL hl
#define GET_SP sp
#define GET_PSW (a << 8 | GET_F)

#define SET_A(v) (a = (v))
#define SET_B(v) (bc = GET_C | (uint64_t)(v) << 8)
#define SET_C(v) (bc = (bc & 0xff00) | (v))
#define SET_D(v) (de = GET_E | (uint64_t)(v) << 8)
#define SET_E(v) (de = (de & 0xff00) | (v))
#define SET_H(v) (hl = GET_L | (uint64_t)(v) << 8)
#define SET_L(v) (hl = (hl & 0xff00) | (v))
#define SET_M(v) WR(hl, v)
#define SET_BC(v) (bc = (v))
#define SET_DE(v) (de = (v))
#define SET_HL(v) (hl = (v))
#define SET_SP(v) (sp = (v))
#define SET_PSW(v) (f = (v), cy = f & 1, ac = f, a = f >> 8, f &= 0xff)

#define RD(address) ((uint64_t)c->mem[address])
#define RD16(address) ((uint64_t)(c->mem[address] | c->mem[(address) + 1] << 8))

#define SZP(v) (f = c->szp[v])
#define INR(r)                              \
    do {                                    \
        uint64_t x_ = GET_##r;              \
        uint64_t t_ = (x_ + 1) & 0xff;      \
        SET_##r(t_);                        \
        ac = x_ ^ t_;                       \
        SZP(t_);                            \
    } while (0)
#define DCR(r)                              \
    do {                                    \
        uint64_t x_ = GET_##r;              \
        uint64_t t_ = (x_ - 1) & 0xff;      \
        SET_##r(t_);                        \
        ac = ~(x_ ^ t_);                    \
        SZP(t_);                            \
    } while (0)
#define ADD_WITH(v, carry)                  \
    do {                                    \
        uint64_t x_ = (v);                  \
        uint64_t t_ = a + x_ + (carry);     \
        ac = a ^ x_ ^ t_;                   \
        cy = t_ >> 8;                       \
        a = t_ & 0xff;                      \
        SZP(a);                             \
    } while (0)
#define ADD(v) ADD_WITH(v, 0)
#define ADC(v) ADD_WITH(v, cy)
#define SUB_WITH(v, borrow, result)         \
    do {                                    \
        uint64_t x_ = (v);                  \
        uint64_t t_ = a - x_ - (borrow);    \
        ac = ~(a ^ x_ ^ t_);                \
        cy = t_ >> 63;                      \
        result = t_ & 0xff;                 \
        SZP(result);                        \
    } while (0)
#define SUB(v) SUB_WITH(v, 0, a)
#define SBB(v) SUB_WITH(v, cy, a)
#define CMP(v)                              \
    do {                                    \
        uint64_t r_;                        \
        SUB_WITH(v, 0, r_);                 \
    } while (0)
#define ANA(v)                              \
    do {                                    \
        uint64_t x_ = (v);                  \
        ac = (a | x_) << 1;                 \
        a &= x_;                            \
        cy = 0;                             \
        SZP(a);                             \
    } while (0)
#define XRA(v) (a ^= (v), ac = cy = 0, SZP(a))
#define ORA(v) (a |= (v), ac = cy = 0, SZP(a))
#define DAD(v)                              \
    do {                                    \
        uint64_t t_ = hl + (v);             \
        cy = t_ >> 16;                      \
        hl = t_ & 0xffff;                   \
    } while (0)
#define RLC (cy = a >> 7, a = (a << 1 & 0xff) | cy)
#define RRC (cy = a & 1, a = a >> 1 | cy << 7)
#define RAL                                 \
    do {                                    \
        uint64_t t_ = a << 1 | cy;          \
        cy = t_ >> 8;                       \
        a = t_ & 0xff;                      \
    } while (0)
#define RAR                                 \
    do {                                    \
        uint64_t t_ = a | cy << 8;          \
        cy = a & 1;                         \
        a = t_ >> 1;                        \
    } while (0)
/* The carry is set when the high digit needs correction, and never cleared. */
#define DAA                                                         \
    do {                                                            \
        uint64_t fix_ = 0;                                          \
        if ((ac & FLAG_AC) || (a & 15) > 9) {                       \
            fix_ = 6;                                               \
        }                                                           \
        if (cy || a > 0x99) {                                       \
            fix_ += 0x60;                                           \
            cy = 1;                                                 \
        }                                                           \
        ac = a ^ fix_ ^ (a + fix_);                                 \
        a = (a + fix_) & 0xff;                                      \
        SZP(a);                                                     \
    } while (0)
#define CMA (a ^= 0xff)
#define STC (cy = 1)
#define CMC (cy ^= 1)
#define NOP ((void)0)
#define XCHG                                \
    do {                                    \
        uint64_t t_ = hl;                   \
        hl = de;                            \
        de = t_;                            \
    } while (0)
#define POP(rr)                             \
    do {                                    \
        uint64_t t_ = RD16(sp);             \
        sp = (sp + 2) & 0xffff;             \
        SET_##rr(t_);                       \
    } while (0)
#define XTHL                                \
    do {                                    \
        uint64_t t_ = RD16(sp);             \
        WR16(sp, hl);                       \
        hl = t_;                            \
    } while (0)

/* Transfers of control end the instruction themselves when they are taken. */
#define GO(address, cycles)                 \
    do {                                    \
        pc = (address);                     \
        left -= COST(cycles, 1);            \
        NEXT;                               \
    } while (0)
#define JUMP GO(IMM16, 10)
#define JUMP_IF(cond)                       \
    if (cond) {                             \
        JUMP;                               \
    }
#define CALL                                \
    do {                                    \
        uint64_t to_ = IMM16;               \
        PUSH((pc + 3) & 0xffff);            \
        GO(to_, 17);                        \
    } while (0)
#define CALL_IF(cond)                       \
    if (cond) {                             \
        CALL;                               \
    }
#define RST(to)                             \
    do {                                    \
        PUSH((pc + 1) & 0xffff);            \
        GO(to, 11);                         \
    } while (0)
#define RETURN_TAKING(cycles)               \
    do {                                    \
        uint64_t to_ = RD16(sp);            \
        sp = (sp + 2) & 0xffff;             \
        GO(to_, cycles);                    \
    } while (0)
#define RETURN RETURN_TAKING(10)
#define RETURN_IF(cond)                     \
    if (cond) {                             \
        RETURN_TAKING(11);                  \
    }
#define PCHL GO(hl, 5)

/* ---- the careful loop ---- */

static void store(i8080 *c, uint64_t address, uint64_t value)
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

#define FIRST(first, ...) first
#define LENGTH(row) FIRST(row)
#define LENGTH_OF(op) [0x##op] = LENGTH(OP_##op),
static const uint8_t instruction_length[256] = { EVERY_OPCODE(LENGTH_OF) };

/* Carries out instructions until the slice is over or attention() is due; `bus` is NULL, or the instruction that an
 * interrupting device has put on the bus, which is then the only one. `single`: one instruction in any case.
 * True when it stands at a breakpoint. */
static bool run_careful(i8080 *c, const uint8_t *bus, bool single)
{
#define IMM8 ((uint64_t)code[1])
#define IMM16 ((uint64_t)(code[1] | code[2] << 8))
#define WR(address, value) store(c, address, value)
#define WR16(address, value)                                                        \
    (store(c, address, (value) & 0xff), store(c, (address) + 1, (value) >> 8))
#define PUSH(value)                                                                 \
    do {                                                                            \
        uint64_t v_ = (value);                                                      \
        sp = (sp - 2) & 0xffff;                                                     \
        store(c, sp + 1, v_ >> 8);                                                  \
        store(c, sp, v_ & 0xff);                                                    \
        if (c->watching && sp < c->lowest_sp) {                                     \
            c->lowest_sp = (uint16_t)sp;                                            \
        }                                                                           \
    } while (0)
#define NEXT goto done
#define SAVE_COUNTS                                                                 \
    (c->cycles = c->slice_end - 1 - (uint64_t)(left >> 24), c->instructions += (uint64_t)(left & 0xffffff), \
     left &= ~(int64_t)0xffffff)
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
    int64_t left = (int64_t)((c->slice_end - c->cycles - 1) << 24);
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

/* True when a chain begins at `address`; marks its opcodes. */
static bool find_chain(i8080 *c, unsigned address, unsigned chain)
{
    unsigned length = chains[chain].length, at[3];
    for (unsigned k = 0; k < length; k++) {
        at[k] = k ? at[k - 1] + instruction_length[chains[chain].opcode[k - 1]] : address;
        if (at[k] >= I8080_SPACE || c->mem[at[k]] != chains[chain].opcode[k] || (c->mark[at[k]] & MARK_BREAK)) {
            return false;
        }
    }
    for (unsigned k = 0; k < length; k++) {
        c->mark[at[k]] |= MARK_CODE;
    }
    return true;
}

/* The handler for what is at `address`; marks the opcodes it depends on. */
static unsigned decode(i8080 *c, unsigned address)
{
    uint8_t opcode = c->mem[address];
    if (c->mark[address] & MARK_BREAK) {
        return HANDLE_CAREFUL;
    }
    for (unsigned i = c->first_chain[opcode]; i < CHAINS && chains[i].opcode[0] == opcode; i++) {
        if (find_chain(c, address, i)) {
            return HANDLE_CHAINS + i;
        }
    }
    c->mark[address] |= MARK_CODE;
    return opcode;
}

/* Stores a word as one, since a host that must gather a later 16-bit load (RET, POP) from two stores waits for both. */
static inline void put16(uint8_t *at, uint64_t value)
{
#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
    uint16_t word = (uint16_t)value;
    memcpy(at, &word, sizeof word);
#else
    at[0] = (uint8_t)value;
    at[1] = (uint8_t)(value >> 8);
#endif
}

/* Runs until the slice is over or attention() is due; true when it stands at a breakpoint. With `labels` it only
 * gives away the table of its handlers. */
static bool run_fast(i8080 *c, bool labels)
{
#define IMM8 RD(pc + 1)
#define IMM16 RD16(pc + 1)
#define NEXT                                \
    do {                                    \
        if (UNLIKELY(left < 0)) {           \
            goto leave;                     \
        }                                   \
        goto *c->code[pc];                  \
    } while (0)
#define WR(address, value)                  \
    do {                                    \
        uint64_t at_ = (address);           \
        if (UNLIKELY(c->mark[at_])) {       \
            goto careful;                   \
        }                                   \
        c->mem[at_] = (uint8_t)(value);     \
    } while (0)
#define WR16(address, value)                                \
    do {                                                    \
        uint64_t at_ = (address);                           \
        if (UNLIKELY(c->mark[at_] | c->mark[at_ + 1])) {    \
            goto careful;                                   \
        }                                                   \
        put16(c->mem + at_, value);                         \
    } while (0)
#define PUSH(value)                         \
    do {                                    \
        uint64_t v_ = (value);              \
        uint64_t sp_ = (sp - 2) & 0xffff;   \
        WR16(sp_, v_);                      \
        sp = sp_;                           \
    } while (0)
#define IN goto careful
#define OUT goto careful
#define EI goto careful
#define DI goto careful
#define HLT goto careful

    static const void *const handlers[HANDLE_CHAINS + CHAINS] = {
#define LABEL(op) [0x##op] = &&op_##op,
#define CHAIN2(p, q) &&chain_##p##_##q,
#define CHAIN3(p, q, r) &&chain_##p##_##q##_##r,
        EVERY_OPCODE(LABEL)
        [HANDLE_UNDECODED] = &&undecoded,
        [HANDLE_CAREFUL] = &&careful,
        [HANDLE_WRAP] = &&wrap,
        EVERY_CHAIN(CHAIN2, CHAIN3)
#undef CHAIN2
#undef CHAIN3
    };

    REGISTERS;
    int64_t left;

    if (labels) {
        c->handlers = handlers;
        return false;
    }
    LOAD_REGISTERS;
    left = (int64_t)((c->slice_end - c->cycles - 1) << 24);
    NEXT;

#define ON                                  \
    if (UNLIKELY(left < 0)) {               \
        goto leave;                         \
    }
#define HANDLER(op)                         \
    op_##op:                                \
    ROW(OP_##op)                            \
    NEXT;
#define CHAIN2(p, q)                        \
    chain_##p##_##q:                        \
    ROW(OP_##p) ON                          \
    ROW(OP_##q)                             \
    NEXT;
#define CHAIN3(p, q, r)                     \
    chain_##p##_##q##_##r:                  \
    ROW(OP_##p) ON                          \
    ROW(OP_##q) ON                          \
    ROW(OP_##r)                             \
    NEXT;
    EVERY_OPCODE(HANDLER)
    EVERY_CHAIN(CHAIN2, CHAIN3)

wrap:
    pc &= 0xffff;
    NEXT;

undecoded:
    c->code[pc] = handlers[decode(c, (unsigned)pc)];
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
    left = (int64_t)((c->slice_end - c->cycles - 1) << 24);
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
    for (unsigned i = CHAINS; i--;) {
        c->first_chain[chains[i].opcode[0]] = (uint8_t)i;
    }
    run_fast(c, true);
    for (unsigned i = 0; i < I8080_SPACE + I8080_PAD; i++) {
        c->code[i] = c->handlers[i < I8080_SPACE ? HANDLE_UNDECODED : HANDLE_WRAP];
    }
    for (unsigned i = 0; i < MIRRORED; i++) {
        c->mark[i] = c->mark[I8080_SPACE + i] = MARK_MIRROR;
    }
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
