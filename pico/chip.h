/* The RP2040's registers, clocks and time, out of its data sheet. Nothing of the pico-sdk is used. */
#ifndef PICO_CHIP_H
#define PICO_CHIP_H

#include <stdbool.h>
#include <stdint.h>

#define REG(address) (*(volatile uint32_t *)(uintptr_t)(address))
/* Sets or clears the bits written, in one access of the bus (data sheet 2.1.2). */
#define SET(address) REG((address) + 0x2000u)
#define CLEAR(address) REG((address) + 0x3000u)

enum { CHIP_HZ = 125000000 };

/* Crystal, PLLs, clocks; takes the peripherals out of reset. */
void chip_start(void);

/* Microseconds, modulo 2^32. */
uint32_t chip_micros(void);

/* True while BOOTSEL is pressed. Nothing may run from flash meanwhile. */
bool chip_bootsel(void);

#endif
