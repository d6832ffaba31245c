/* Intel 8080A core: the programmer's view
 *
 *      A  | F = S Z 0 AC 0 P 1 CY          SP  stack, grows down, low byte at the lower address
 *      B  | C                              PC
 *      D  | E                              interrupt enable INTE, one-instruction delay after EI
 *      H  | L     M = memory at HL         ports 00-FF by IN and OUT
 *
 * A library: no I/O, no globals, any number of instances. The host maps memory, gives two functions for IN and OUT,
 * and runs the processor for a number of cycles; every run ends on an instruction boundary, the first at which
 * the cycles are used up. Every flag, every cycle count and the twelve undocumented duplicate opcodes are those
 * of the chip. Interrupts are taken between instructions; the device puts up to three bytes on the bus.
 *
 * 400 KB for each; i8080_small.h is the same for a microcontroller (README.md, section "On a microcontroller").
 *
 * NOT IMPLEMENTED: HOLD and bus-level signals (SYNC, status byte, READY wait states); memory-mapped devices;
 * cycles inside an instruction (a device sees the count at the instruction's start).
 */
#ifndef I8080_H
#define I8080_H

#include "i8080_host.h"

/* Kinds of memory. */
typedef enum {
    I8080_RAM,
    I8080_ROM,      /* writes do nothing */
    I8080_OPEN      /* nothing there: reads give FF, writes do nothing */
} i8080_kind;

typedef struct i8080 i8080;

/* An instruction in ROM, and whether a translation may be entered at it. */
typedef struct {
    uint16_t address;
    uint8_t length, bytes[3];
    bool entry;
} i8080_instruction;

/* A program in ROM as C (i8080_translated.c): what it was made from, and what carries it out from PC on. */
typedef struct {
    const i8080_instruction *instructions;
    size_t count;
    void (*run)(i8080 *c);
} i8080_translation;

enum { I8080_PAD = 8 };

struct i8080 {
    /* Registers. Read and write them freely between runs. */
    uint8_t a, f;
    uint16_t bc, de, hl, sp, pc;
    bool inte, halted;

    /* Since i8080_init: never reset by the core itself. */
    uint64_t cycles, instructions;
    uint64_t rom_writes;            /* writes that did nothing, since there was ROM */
    uint16_t rom_written;           /* where the last of them went */

    /* What i8080_watch() switches on. */
    bool watching;
    uint16_t lowest_sp;             /* lowest SP after a PUSH, CALL or RST; FFFF: none yet */
    uint8_t *written;               /* the host's, of I8080_SPACE bytes: 1 for every byte of RAM written; NULL: none */
    uint16_t fetch_first, fetch_last;   /* instructions are expected to start inside */
    uint64_t fetches_outside;
    uint16_t first_outside;         /* PC of the first that was not */

    /* The rest is the core's own. */
    i8080_in_fn *in;
    i8080_out_fn *out;
    void *user;
    bool stop_wanted, shadow;       /* shadow: the instruction after EI is still to come */
    bool irq;
    uint8_t irq_code[3];
    uint64_t slice_end;
    const i8080_translation *translation;   /* in use; NULL: none */
    const void *const *handlers;    /* of the fast loop, see i8080.c */
    uint8_t szp[256];               /* S, Z and P of a result */
    uint8_t mem[I8080_SPACE + I8080_PAD];   /* the first bytes again at the end: a 16-bit read may run over */
    uint8_t skew1[1024];            /* keeps mem[x] and mark[x] out of each other's way in the host's cache */
    uint8_t mark[I8080_SPACE + I8080_PAD];
    uint8_t skew2[1024];
    const void *code[I8080_SPACE + I8080_PAD];  /* the fast loop's handler for the instruction at each address */
};

/* All RAM, zero, at PC 0. `in` and `out` are called with `user`; they may call i8080_stop and i8080_interrupt and
 * read registers, counters and memory, but change none of these. */
void i8080_init(i8080 *c, i8080_in_fn *in, i8080_out_fn *out, void *user);

/* The RESET line: PC = 0, interrupts off, not halted. Registers and memory stay, as on the chip. */
void i8080_reset(i8080 *c);

/* Makes first..last memory of that kind; the contents stay (but read FF once OPEN). */
void i8080_map(i8080 *c, uint16_t first, uint16_t last, i8080_kind kind);

/* Memory as the host sees it: poke writes ROM too, and does nothing on an open bus. */
uint8_t i8080_peek(const i8080 *c, uint16_t address);
void i8080_poke(i8080 *c, uint16_t address, uint8_t value);

/* True when an instruction was fetched there since the byte was last written. (Not while watching, nor by a
 * translation.) */
bool i8080_fetched(const i8080 *c, uint16_t address);

/* Ends the run before the instruction at that address; on = false takes the breakpoint away again. */
void i8080_break(i8080 *c, uint16_t address, bool on);

/* Has a translation carry out the instructions that it was made from, when they all stand in memory that is not RAM, without a
 * breakpoint; else it is false. What happens is the same, cycle for cycle, in a third of the time. A change of these
 * bytes or of their kind, and a breakpoint on one of them, ends it. */
bool i8080_translate(i8080 *c, const i8080_translation *t);

/* Raises the interrupt line; `code` is what the device will put on the bus (RST n: one byte). It stays raised until
 * it is taken or i8080_interrupt_clear() lowers it. */
void i8080_interrupt(i8080 *c, const uint8_t code[3]);
void i8080_interrupt_clear(i8080 *c);

/* Ends the run in progress after the present instruction (else the next run at once). */
void i8080_stop(i8080 *c);

/* Starts or ends watching: lowest stack, bytes written and instructions fetched outside first..last. Slower while on,
 * free when off. Starting clears all but written[], which is the host's. */
void i8080_watch(i8080 *c, bool on, uint16_t first, uint16_t last);

/* Runs until at least so many more cycles have passed, or until something else ends it. */
i8080_reason i8080_run(i8080 *c, uint64_t cycles);

#endif
