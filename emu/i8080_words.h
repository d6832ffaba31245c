/* The 8080's registers in locals, and what the words of the instruction table (i8080_ops.h) mean in every loop that
 * carries it out. What writes memory, the operands, ports and NEXT are each loop's own.
 *
 * Cycles and instructions are counted in one number, `left`: cycles left in the slice times 2^COUNT_BITS, plus the
 * instructions done. One subtraction an instruction, and the sign says when the slice is over. A slice is short
 * enough for the number, and has less than 2^COUNT_BITS instructions, which take 4 cycles at the least.
 */
#include "i8080_ops.h"

/* A register in a local, and cycles and instructions as one number: wide where that is fast, narrow for a host of
 * 32 bits, whose file says I8080_NARROW. */
#ifdef I8080_NARROW
typedef uint32_t reg;
typedef int32_t tally;
enum { COUNT_BITS = 14 };
#else
typedef uint64_t reg;
typedef int64_t tally;
enum { COUNT_BITS = 24 };
#endif

enum {
    SIGN_BIT = 8 * sizeof(reg) - 1,
    COUNT_MASK = (1 << COUNT_BITS) - 1, /* the instructions in a tally */
    SLICE = 1 << (COUNT_BITS + 1)       /* cycles in a slice, at the most */
};

#define UNLIKELY(x) __builtin_expect(!!(x), 0)

#define FIRST(first, ...) first
#define LENGTH(row) FIRST(row)

/* f holds S, Z and P in their places, cy is 0 or 1, bit 4 of ac is AC; other bits of f and ac are noise. */
#define REGISTERS reg a, f, cy, ac, bc, de, hl, sp, pc
#define LOAD_REGISTERS                                                                              \
    (a = c->a, f = c->f, cy = c->f & 1, ac = c->f, bc = c->bc, de = c->de, hl = c->hl, sp = c->sp,  \
     pc = c->pc)
#define SAVE_REGISTERS                                                                              \
    (c->a = (uint8_t)a, c->f = (uint8_t)GET_F, c->bc = (uint16_t)bc, c->de = (uint16_t)de,          \
     c->hl = (uint16_t)hl, c->sp = (uint16_t)sp, c->pc = (uint16_t)pc)

/* cycles and instructions as one number to subtract from `left` */
#define COST(cycles, instructions) (((tally)(cycles) << COUNT_BITS) - (instructions))

#define COUNT_SLICE (left = (tally)((c->slice_end - c->cycles - 1) << COUNT_BITS))
#define SAVE_COUNTS                                                                 \
    (c->cycles = c->slice_end - 1 - (uint64_t)(left >> COUNT_BITS),                 \
     c->instructions += (uint64_t)(left & COUNT_MASK), left &= ~(tally)COUNT_MASK)

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
#define SET_B(v) (bc = GET_C | (reg)(v) << 8)
#define SET_C(v) (bc = (bc & 0xff00) | (v))
#define SET_D(v) (de = GET_E | (reg)(v) << 8)
#define SET_E(v) (de = (de & 0xff00) | (v))
#define SET_H(v) (hl = GET_L | (reg)(v) << 8)
#define SET_L(v) (hl = (hl & 0xff00) | (v))
#define SET_M(v) WR(hl, v)
#define SET_BC(v) (bc = (v))
#define SET_DE(v) (de = (v))
#define SET_HL(v) (hl = (v))
#define SET_SP(v) (sp = (v))
#define SET_PSW(v) (f = (v), cy = f & 1, ac = f, a = f >> 8, f &= 0xff)

#define RD(address) ((reg)c->mem[address])
#define RD16(address) ((reg)(c->mem[address] | c->mem[(address) + 1] << 8))

#define SZP(v) (f = c->szp[v])
#define INR(r)                              \
    do {                                    \
        reg x_ = GET_##r;                   \
        reg t_ = (x_ + 1) & 0xff;           \
        SET_##r(t_);                        \
        ac = x_ ^ t_;                       \
        SZP(t_);                            \
    } while (0)
#define DCR(r)                              \
    do {                                    \
        reg x_ = GET_##r;                   \
        reg t_ = (x_ - 1) & 0xff;           \
        SET_##r(t_);                        \
        ac = ~(x_ ^ t_);                    \
        SZP(t_);                            \
    } while (0)
#define ADD_WITH(v, carry)                  \
    do {                                    \
        reg x_ = (v);                       \
        reg t_ = a + x_ + (carry);          \
        ac = a ^ x_ ^ t_;                   \
        cy = t_ >> 8;                       \
        a = t_ & 0xff;                      \
        SZP(a);                             \
    } while (0)
#define ADD(v) ADD_WITH(v, 0)
#define ADC(v) ADD_WITH(v, cy)
#define SUB_WITH(v, borrow, result)         \
    do {                                    \
        reg x_ = (v);                       \
        reg t_ = a - x_ - (borrow);         \
        ac = ~(a ^ x_ ^ t_);                \
        cy = t_ >> SIGN_BIT;                \
        result = t_ & 0xff;                 \
        SZP(result);                        \
    } while (0)
#define SUB(v) SUB_WITH(v, 0, a)
#define SBB(v) SUB_WITH(v, cy, a)
#define CMP(v)                              \
    do {                                    \
        reg r_;                             \
        SUB_WITH(v, 0, r_);                 \
    } while (0)
#define ANA(v)                              \
    do {                                    \
        reg x_ = (v);                       \
        ac = (a | x_) << 1;                 \
        a &= x_;                            \
        cy = 0;                             \
        SZP(a);                             \
    } while (0)
#define XRA(v) (a ^= (v), ac = cy = 0, SZP(a))
#define ORA(v) (a |= (v), ac = cy = 0, SZP(a))
#define DAD(v)                              \
    do {                                    \
        reg t_ = hl + (v);                  \
        cy = t_ >> 16;                      \
        hl = t_ & 0xffff;                   \
    } while (0)
#define RLC (cy = a >> 7, a = (a << 1 & 0xff) | cy)
#define RRC (cy = a & 1, a = a >> 1 | cy << 7)
#define RAL                                 \
    do {                                    \
        reg t_ = a << 1 | cy;               \
        cy = t_ >> 8;                       \
        a = t_ & 0xff;                      \
    } while (0)
#define RAR                                 \
    do {                                    \
        reg t_ = a | cy << 8;               \
        cy = a & 1;                         \
        a = t_ >> 1;                        \
    } while (0)
/* The carry is set when the high digit needs correction, and never cleared. */
#define DAA                                                         \
    do {                                                            \
        reg fix_ = 0;                                               \
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
        reg t_ = hl;                        \
        hl = de;                            \
        de = t_;                            \
    } while (0)
#define POP(rr)                             \
    do {                                    \
        reg t_ = RD16(sp);                  \
        sp = (sp + 2) & 0xffff;             \
        SET_##rr(t_);                       \
    } while (0)
#define XTHL                                \
    do {                                    \
        reg t_ = RD16(sp);                  \
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
        reg to_ = IMM16;                    \
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
        reg to_ = RD16(sp);                 \
        sp = (sp + 2) & 0xffff;             \
        GO(to_, cycles);                    \
    } while (0)
#define RETURN RETURN_TAKING(10)
#define RETURN_IF(cond)                     \
    if (cond) {                             \
        RETURN_TAKING(11);                  \
    }
#define PCHL GO(hl, 5)

