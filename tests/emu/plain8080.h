/* A second 8080, written to be obviously right: the oracle of the tests and the yardstick of the benchmark.
 *
 * It shares nothing with emu/i8080.c. Instructions are decoded by their octal digits as Intel's manual lays them out,
 * every byte of memory and every port goes through a function of the host's, and flags are kept as truth values.
 *
 *      opcode  xx yyy zzz      registers  0 B, 1 C, 2 D, 3 E, 4 H, 5 L, 6 memory at HL, 7 A
 *
 * NOT IMPLEMENTED: stopping inside a run, more than one byte from the interrupting device (the tests need neither).
 */
#ifndef PLAIN8080_H
#define PLAIN8080_H

#include <stdbool.h>
#include <stdint.h>

typedef struct plain8080 {
    uint8_t r[8];               /* by register number; r[6] unused */
    bool s, z, ac, p, cy;
    uint16_t sp, pc;
    bool inte, inte_next, halted;   /* inte_next: EI was the last instruction */
    uint64_t cycles, instructions;
    uint8_t (*read)(void *user, uint16_t address);
    void (*write)(void *user, uint16_t address, uint8_t value);
    uint8_t (*in)(void *user, uint8_t port);
    void (*out)(void *user, uint8_t port, uint8_t value);
    void *user;
} plain8080;

/* Carries out one instruction (none when halted). */
void plain8080_step(plain8080 *c);

/* Takes an interrupt with that opcode on the bus if it may; true when it was taken. */
bool plain8080_interrupt(plain8080 *c, uint8_t opcode);

/* The flags as PUSH PSW stores them, and back. */
uint8_t plain8080_flags(const plain8080 *c);
void plain8080_set_flags(plain8080 *c, uint8_t flags);

#endif
