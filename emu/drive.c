/* The machine's drive as the board sees it. See drive.h. */
#include "drive.h"

enum { STEPS = DRIVE_X_STEP | DRIVE_Y_STEP, DIRECTION_OF_STEP = 1 /* bits further up */ };

void drive_init(drive *d)
{
    *d = (drive){ .paused = true };
}

void drive_reset(drive *d)
{
    d->latch = 0;
    d->paused = true;
}

static void count_gap(drive *d, uint64_t cycles)
{
    if (!d->paused) {
        uint64_t gap = cycles - d->stepped_at;
        d->gaps++;
        d->gap_cycles += gap;
        d->longest_gap = gap > d->longest_gap ? gap : d->longest_gap;
    }
    d->paused = false;
    d->stepped_at = cycles;
}

void drive_out(drive *d, uint8_t value, uint64_t cycles, void *user)
{
    unsigned rising = value & ~d->latch & STEPS;
    unsigned turned = (value ^ d->latch) & ((value & STEPS) << DIRECTION_OF_STEP);
    d->latch = value;
    d->hasty += turned != 0;
    if (!rising) {
        return;
    }
    d->steps++;
    count_gap(d, cycles);
    d->stopped = d->stopped || d->steps == d->stop_at;
    if (d->step) {
        d->step(user, value, cycles);
    }
}

uint8_t drive_in(const drive *d, uint64_t cycles, double hz)
{
    bool feed = d->feed_hz > 0 ? (uint64_t)((double)cycles * 2 * d->feed_hz / hz) & 1 : !(d->latch & STEPS);
    return (uint8_t)((feed ? DRIVE_FEED : 0) | (d->stopped ? DRIVE_STOP : 0));
}

void drive_key(drive *d)
{
    d->stopped = d->stopped && d->stop_stays;
    d->paused = true;
}
