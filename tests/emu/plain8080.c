/* A second 8080, written to be obviously right. See plain8080.h. */
#include "plain8080.h"

enum { B, C, D, E, H, L, M, A };

/* States from Intel's 8080 manual; conditional calls and returns: when not taken. */
static const uint8_t CYCLES[256] = {
    /*        0   1   2   3   4   5   6   7   8   9   A   B   C   D   E   F */
    /* 0 */   4, 10,  7,  5,  5,  5,  7,  4,  4, 10,  7,  5,  5,  5,  7,  4,
    /* 1 */   4, 10,  7,  5,  5,  5,  7,  4,  4, 10,  7,  5,  5,  5,  7,  4,
    /* 2 */   4, 10, 16,  5,  5,  5,  7,  4,  4, 10, 16,  5,  5,  5,  7,  4,
    /* 3 */   4, 10, 13,  5, 10, 10, 10,  4,  4, 10, 13,  5,  5,  5,  7,  4,
    /* 4 */   5,  5,  5,  5,  5,  5,  7,  5,  5,  5,  5,  5,  5,  5,  7,  5,
    /* 5 */   5,  5,  5,  5,  5,  5,  7,  5,  5,  5,  5,  5,  5,  5,  7,  5,
    /* 6 */   5,  5,  5,  5,  5,  5,  7,  5,  5,  5,  5,  5,  5,  5,  7,  5,
    /* 7 */   7,  7,  7,  7,  7,  7,  7,  7,  5,  5,  5,  5,  5,  5,  7,  5,
    /* 8 */   4,  4,  4,  4,  4,  4,  7,  4,  4,  4,  4,  4,  4,  4,  7,  4,
    /* 9 */   4,  4,  4,  4,  4,  4,  7,  4,  4,  4,  4,  4,  4,  4,  7,  4,
    /* A */   4,  4,  4,  4,  4,  4,  7,  4,  4,  4,  4,  4,  4,  4,  7,  4,
    /* B */   4,  4,  4,  4,  4,  4,  7,  4,  4,  4,  4,  4,  4,  4,  7,  4,
    /* C */   5, 10, 10, 10, 11, 11,  7, 11,  5, 10, 10, 10, 11, 17,  7, 11,
    /* D */   5, 10, 10, 10, 11, 11,  7, 11,  5, 10, 10, 10, 11, 17,  7, 11,
    /* E */   5, 10, 10, 18, 11, 11,  7, 11,  5,  5, 10,  4, 11, 17,  7, 11,
    /* F */   5, 10, 10,  4, 11, 11,  7, 11,  5,  5, 10,  4, 11, 17,  7, 11,
};

enum { CYCLES_TAKEN = 6 };      /* more, for a conditional call or return that is taken */

static uint8_t read8(plain8080 *c, uint16_t address)
{
    return c->read(c->user, address);
}

static void write8(plain8080 *c, uint16_t address, uint8_t value)
{
    c->write(c->user, address, value);
}

static uint16_t read16(plain8080 *c, uint16_t address)
{
    uint8_t low = read8(c, address);
    return (uint16_t)(low | read8(c, (uint16_t)(address + 1)) << 8);
}

static void write16(plain8080 *c, uint16_t address, uint16_t value)
{
    write8(c, address, (uint8_t)value);
    write8(c, (uint16_t)(address + 1), (uint8_t)(value >> 8));
}

static uint8_t next8(plain8080 *c)
{
    return read8(c, c->pc++);
}

static uint16_t next16(plain8080 *c)
{
    uint8_t low = next8(c);
    return (uint16_t)(low | next8(c) << 8);
}

static uint16_t hl(const plain8080 *c)
{
    return (uint16_t)(c->r[H] << 8 | c->r[L]);
}

static uint8_t get(plain8080 *c, unsigned r)
{
    return r == M ? read8(c, hl(c)) : c->r[r];
}

static void set(plain8080 *c, unsigned r, uint8_t value)
{
    if (r == M) {
        write8(c, hl(c), value);
    } else {
        c->r[r] = value;
    }
}

/* Pairs 0 BC, 1 DE, 2 HL, 3 SP. */
static uint16_t get_pair(const plain8080 *c, unsigned pair)
{
    return pair == 3 ? c->sp : (uint16_t)(c->r[2 * pair] << 8 | c->r[2 * pair + 1]);
}

static void set_pair(plain8080 *c, unsigned pair, uint16_t value)
{
    if (pair == 3) {
        c->sp = value;
    } else {
        c->r[2 * pair] = (uint8_t)(value >> 8);
        c->r[2 * pair + 1] = (uint8_t)value;
    }
}

uint8_t plain8080_flags(const plain8080 *c)
{
    return (uint8_t)(c->s << 7 | c->z << 6 | c->ac << 4 | c->p << 2 | 1 << 1 | c->cy);
}

void plain8080_set_flags(plain8080 *c, uint8_t flags)
{
    c->s = flags >> 7 & 1;
    c->z = flags >> 6 & 1;
    c->ac = flags >> 4 & 1;
    c->p = flags >> 2 & 1;
    c->cy = flags & 1;
}

static bool even_parity(uint8_t value)
{
    value ^= value >> 4;
    value ^= value >> 2;
    value ^= value >> 1;
    return !(value & 1);
}

static void set_szp(plain8080 *c, uint8_t value)
{
    c->s = value >> 7;
    c->z = value == 0;
    c->p = even_parity(value);
}

/* The adder: sums with the carries out of bits 3 and 7. Subtraction adds the complement. */
static uint8_t add(plain8080 *c, uint8_t x, uint8_t y, bool carry)
{
    c->ac = (x & 15) + (y & 15) + carry > 15;
    c->cy = x + y + carry > 255;
    uint8_t sum = (uint8_t)(x + y + carry);
    set_szp(c, sum);
    return sum;
}

static uint8_t subtract(plain8080 *c, uint8_t x, uint8_t y, bool borrow)
{
    uint8_t difference = add(c, x, (uint8_t)~y, !borrow);
    c->cy = !c->cy;
    return difference;
}

static void logic(plain8080 *c, uint8_t value, bool ac)
{
    c->r[A] = value;
    c->cy = false;
    c->ac = ac;
    set_szp(c, value);
}

/* ADD ADC SUB SBB ANA XRA ORA CMP */
static void arithmetic(plain8080 *c, unsigned operation, uint8_t value)
{
    uint8_t a = c->r[A];
    switch (operation) {
    case 0: c->r[A] = add(c, a, value, false); break;
    case 1: c->r[A] = add(c, a, value, c->cy); break;
    case 2: c->r[A] = subtract(c, a, value, false); break;
    case 3: c->r[A] = subtract(c, a, value, c->cy); break;
    case 4: logic(c, a & value, (a | value) >> 3 & 1); break;
    case 5: logic(c, a ^ value, false); break;
    case 6: logic(c, a | value, false); break;
    case 7: subtract(c, a, value, false); break;
    }
}

/* RLC RRC RAL RAR DAA CMA STC CMC */
static void accumulator(plain8080 *c, unsigned operation)
{
    uint8_t a = c->r[A];
    switch (operation) {
    case 0: c->r[A] = (uint8_t)(a << 1 | a >> 7); c->cy = a >> 7; break;
    case 1: c->r[A] = (uint8_t)(a >> 1 | a << 7); c->cy = a & 1; break;
    case 2: c->r[A] = (uint8_t)(a << 1 | c->cy); c->cy = a >> 7; break;
    case 3: c->r[A] = (uint8_t)(a >> 1 | c->cy << 7); c->cy = a & 1; break;
    case 4: {
        bool carry = c->cy || a > 0x99;
        uint8_t low = c->ac || (a & 15) > 9 ? 6 : 0;
        c->r[A] = add(c, a, (uint8_t)(low + (carry ? 0x60 : 0)), false);
        c->cy = carry;
        break;
    }
    case 5: c->r[A] = (uint8_t)~a; break;
    case 6: c->cy = true; break;
    case 7: c->cy = !c->cy; break;
    }
}

/* NZ Z NC C PO PE P M */
static bool holds(const plain8080 *c, unsigned condition)
{
    const bool flags[4] = { c->z, c->cy, c->p, c->s };
    return flags[condition >> 1] == (condition & 1);
}

static void push(plain8080 *c, uint16_t value)
{
    c->sp -= 2;
    write16(c, c->sp, value);
}

static uint16_t pop(plain8080 *c)
{
    uint16_t value = read16(c, c->sp);
    c->sp += 2;
    return value;
}

static void call(plain8080 *c, uint16_t address)
{
    push(c, c->pc);
    c->pc = address;
}

/* Opcodes 00yyyzzz. */
static void group0(plain8080 *c, unsigned y, unsigned z)
{
    unsigned pair = y >> 1;
    switch (z) {
    case 0: break;
    case 1:
        if (y & 1) {
            unsigned sum = hl(c) + get_pair(c, pair);
            c->cy = sum >> 16;
            set_pair(c, 2, (uint16_t)sum);
        } else {
            set_pair(c, pair, next16(c));
        }
        break;
    case 2:
        switch (y) {
        case 0: case 2: write8(c, get_pair(c, pair), c->r[A]); break;
        case 1: case 3: c->r[A] = read8(c, get_pair(c, pair)); break;
        case 4: write16(c, next16(c), hl(c)); break;
        case 5: set_pair(c, 2, read16(c, next16(c))); break;
        case 6: write8(c, next16(c), c->r[A]); break;
        case 7: c->r[A] = read8(c, next16(c)); break;
        }
        break;
    case 3: set_pair(c, pair, (uint16_t)(get_pair(c, pair) + (y & 1 ? -1 : 1))); break;
    case 4: case 5: {
        bool cy = c->cy;
        uint8_t value = get(c, y);
        set(c, y, z == 4 ? add(c, value, 1, false) : subtract(c, value, 1, false));
        c->cy = cy;
        break;
    }
    case 6: set(c, y, next8(c)); break;
    case 7: accumulator(c, y); break;
    }
}

/* Opcodes 11yyyzzz. */
static void group3(plain8080 *c, unsigned y, unsigned z)
{
    unsigned pair = y >> 1;
    switch (z) {
    case 0:
        if (holds(c, y)) {
            c->pc = pop(c);
            c->cycles += CYCLES_TAKEN;
        }
        break;
    case 1:
        switch (y) {
        case 1: case 3: c->pc = pop(c); break;
        case 5: c->pc = hl(c); break;
        case 7: c->sp = hl(c); break;
        case 6: {
            uint16_t psw = pop(c);
            c->r[A] = (uint8_t)(psw >> 8);
            plain8080_set_flags(c, (uint8_t)psw);
            break;
        }
        default: set_pair(c, pair, pop(c));
        }
        break;
    case 2: {
        uint16_t address = next16(c);
        if (holds(c, y)) {
            c->pc = address;
        }
        break;
    }
    case 3:
        switch (y) {
        case 0: case 1: c->pc = next16(c); break;
        case 2: c->out(c->user, next8(c), c->r[A]); break;
        case 3: c->r[A] = c->in(c->user, next8(c)); break;
        case 4: {
            uint16_t top = read16(c, c->sp);
            write16(c, c->sp, hl(c));
            set_pair(c, 2, top);
            break;
        }
        case 5: {
            uint16_t de = get_pair(c, 1);
            set_pair(c, 1, hl(c));
            set_pair(c, 2, de);
            break;
        }
        case 6: c->inte = false; break;
        case 7: c->inte = c->inte_next = true; break;
        }
        break;
    case 4: {
        uint16_t address = next16(c);
        if (holds(c, y)) {
            call(c, address);
            c->cycles += CYCLES_TAKEN;
        }
        break;
    }
    case 5:
        if (y & 1) {
            call(c, next16(c));
        } else if (y == 6) {
            push(c, (uint16_t)(c->r[A] << 8 | plain8080_flags(c)));
        } else {
            push(c, get_pair(c, pair));
        }
        break;
    case 6: arithmetic(c, y, next8(c)); break;
    case 7: call(c, (uint16_t)(8 * y)); break;
    }
}

static void execute(plain8080 *c, uint8_t opcode)
{
    unsigned y = opcode >> 3 & 7, z = opcode & 7;
    c->inte_next = false;
    c->instructions++;
    c->cycles += CYCLES[opcode];
    switch (opcode >> 6) {
    case 0:
        group0(c, y, z);
        break;
    case 1:
        if (y == M && z == M) {
            c->halted = true;
        } else {
            set(c, y, get(c, z));
        }
        break;
    case 2:
        arithmetic(c, y, get(c, z));
        break;
    case 3:
        group3(c, y, z);
        break;
    }
}

void plain8080_step(plain8080 *c)
{
    if (!c->halted) {
        execute(c, next8(c));
    }
}

bool plain8080_interrupt(plain8080 *c, uint8_t opcode)
{
    if (!c->inte || c->inte_next) {
        return false;
    }
    c->inte = c->halted = false;
    execute(c, opcode);
    return true;
}
