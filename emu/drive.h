/* The machine's drive as the board sees it: one port, 14H, of a latch and two lines (docs/spec/drive.md)
 *
 *      port 14H    b7       b6 b5 b4    b3            b2        b1            b0
 *      out         cutting              Y direction   Y step    X direction   X step      direction 1: towards -
 *      in                                                       stop          feed clock
 *
 * A step is counted when its bit rises; the pulse may be as short as two instructions make it. A reset clears the latch.
 *
 * The feed clock is the inverse of the step bits, so that each pulse makes its own edge, or with `feed_hz` a square wave of
 * the processor's time, low at power-on. The stop line rises with the pulse of step `stop_at`, and falls when the board
 * takes the operator's next key, or with `stop_stays` never: then it is a limit switch that the machine stands on.
 *
 * NOT IMPLEMENTED: motors (a step is made however fast it comes), and the ends of the machine's travel.
 */
#ifndef DRIVE_H
#define DRIVE_H

#include <stdbool.h>
#include <stdint.h>

enum {
    // clang-format off
    DRIVE_PORT = 0x14,
    DRIVE_X_STEP = 0x01, DRIVE_X_MINUS = 0x02, DRIVE_Y_STEP = 0x04, DRIVE_Y_MINUS = 0x08, DRIVE_CUTTING = 0x80,
    DRIVE_FEED = 0x01, DRIVE_STOP = 0x02
    // clang-format on
};

/* Receives each step: the port's value with the pulse up, and its time (cycles). */
typedef void drive_sink(void *user, uint8_t value, uint64_t cycles);

typedef struct {
    /* Set these before the first run. */
    double feed_hz;             /* 0: full speed */
    uint64_t stop_at;           /* counted from 1; 0: never */
    bool stop_stays;
    drive_sink *step;           /* NULL: nobody listens */

    uint8_t latch;              /* what is on the lines to the machine */
    bool stopped;               /* the stop line is up */
    uint64_t steps;             /* since power-on */
    uint64_t hasty; /* steps that came together with their direction, or whose direction changed under the pulse */
    /* From one step to the next, where the board has taken no key in between: */
    uint64_t gaps, gap_cycles, longest_gap;

    /* The rest is the drive's own. */
    uint64_t stepped_at;
    bool paused; /* a key has been taken since the last step, or there was none */
} drive;

void drive_init(drive *d);

/* The reset button: nothing moves, nothing cuts. */
void drive_reset(drive *d);

/* The board writes and reads the port; `hz`: the processor's clock. */
void drive_out(drive *d, uint8_t value, uint64_t cycles, void *user);
uint8_t drive_in(const drive *d, uint64_t cycles, double hz);

/* The board has taken a key that the operator pressed. */
void drive_key(drive *d);

#endif
