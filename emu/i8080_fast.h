/* The words that i8080_words.h lacks, for loops that write plain RAM at once and `goto careful` in front of everything rare:
 * a write to a byte that is marked, a port, EI, DI, HLT. Operands are still the loop's own.
 */
#include <string.h>

/* Stores a word as one, since a host that must gather a later 16-bit load (RET, POP) from two stores waits for both. */
static inline void put16(uint8_t *at, reg value)
{
#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
    uint16_t word = (uint16_t)value;
    memcpy(at, &word, sizeof word);
#else
    at[0] = (uint8_t)value;
    at[1] = (uint8_t)(value >> 8);
#endif
}

#define WR(address, value)                  \
    do {                                    \
        reg at_ = (address);                \
        if (UNLIKELY(c->mark[at_])) {       \
            goto careful;                   \
        }                                   \
        c->mem[at_] = (uint8_t)(value);     \
    } while (0)
#define WR16(address, value)                                \
    do {                                                    \
        reg at_ = (address);                                \
        if (UNLIKELY(c->mark[at_] | c->mark[at_ + 1])) {    \
            goto careful;                                   \
        }                                                   \
        put16(c->mem + at_, value);                         \
    } while (0)
#define PUSH(value)                         \
    do {                                    \
        reg v_ = (value);                   \
        reg sp_ = (sp - 2) & 0xffff;        \
        WR16(sp_, v_);                      \
        sp = sp_;                           \
    } while (0)
#define IN goto careful
#define OUT goto careful
#define EI goto careful
#define DI goto careful
#define HLT goto careful
