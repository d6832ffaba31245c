/* The drive's port 14H (docs/spec/drive.md) on the Pico's pins
 *
 *      GP2, GP3    X driver: STEP, DIR
 *      GP4, GP5    Y driver: STEP, DIR
 *      GP6         cutting
 *      GP7         stop: 1 stops, pulled up; a chain of closed switches to ground
 *      GP8         feed clock from outside, pulled down
 *      GP9         a servo that lifts the pen: 1.25 ms up, 1.75 ms down, 50 times a second
 */
#ifndef PICO_MOTORS_H
#define PICO_MOTORS_H

#include <stdint.h>

enum {
    FEED_FULL = 0,        /* the inverse of the step bits: as fast as the 8080 goes */
    FEED_MOST = 50000,    /* steps a second, a square wave of the chip's timer */
    FEED_PIN = 0xffff     /* GP8 */
};

void motors_start(void);

/* FEED_FULL, steps a second, or FEED_PIN. */
void motors_feed(uint32_t feed);

/* The port. motors_out lets a pen 250 ms to go up or down, for which it calls `meanwhile` over and over. */
uint8_t motors_in(void);
void motors_out(uint8_t latch, void (*meanwhile)(void));

#endif
