/* The 8080 core of i8080.h for a microcontroller: under 1 KiB of RAM, registers of 32 bits
 *
 * It carries out the same instructions, with the same flags, cycles, interrupts and undocumented opcodes, and is run and
 * asked alike. Memory is the host's, in pages of 1 KiB: a ROM may stay in flash, and RAM that is not there takes none.
 *
 * NOT IMPLEMENTED, besides what the large core has not: breakpoints, watching, translations, counts of writes to ROM.
 */
#ifndef I8080_SMALL_H
#define I8080_SMALL_H

#include "i8080_host.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { I8080_SMALL_PAGE = 0x400, I8080_SMALL_PAGES = I8080_SPACE / I8080_SMALL_PAGE };

typedef struct {
    /* Registers. Read and write them freely between runs. */
    uint8_t a, f;
    uint16_t bc, de, hl, sp, pc;
    bool inte, halted;

    /* Since i8080_small_init: never reset by the core itself. */
    uint64_t cycles, instructions;

    /* The rest is the core's own. */
    i8080_in_fn *in;
    i8080_out_fn *out;
    void *user;
    bool stop_wanted, shadow;       /* shadow: the instruction after EI is still to come */
    bool irq;
    uint8_t irq_code[3];
    uint64_t slice_end;
    const uint8_t *read[I8080_SMALL_PAGES];     /* what stands in each page */
    uint8_t *write[I8080_SMALL_PAGES];          /* what writes to it go to; NULL: they do nothing */
} i8080_small;

/* No memory at all, PC 0. `in` and `out` as in i8080_init. */
void i8080_small_init(i8080_small *c, i8080_in_fn *in, i8080_out_fn *out, void *user);

/* Makes the pages first..last memory: `read` is what stands there (NULL: nothing, reads give FF), `write` what writes go
 * to (NULL: they do nothing). RAM is the same twice. The bytes stay the host's; it may change them between runs. */
void i8080_small_map(i8080_small *c, uint16_t first, uint16_t last, const uint8_t *read, uint8_t *write);

/* Memory as the processor sees it. */
uint8_t i8080_small_peek(const i8080_small *c, uint16_t address);

/* As of the large core. */
void i8080_small_reset(i8080_small *c);
void i8080_small_interrupt(i8080_small *c, const uint8_t code[3]);
void i8080_small_interrupt_clear(i8080_small *c);
void i8080_small_stop(i8080_small *c);
i8080_reason i8080_small_run(i8080_small *c, uint64_t cycles);

#ifdef __cplusplus
}
#endif

#endif
