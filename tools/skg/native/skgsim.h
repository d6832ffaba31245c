/* The 3B controller's inner loop: one block, one step of 1 um at a time, integers only. */
#ifndef SKGSIM_H
#define SKGSIM_H

#include <stdint.h>

/* Return values of skgsim_run. */
enum { SKGSIM_DONE = 0, SKGSIM_MORE = 1, SKGSIM_STALLED = 2 };

/* A block on its way. Python lays the same struct out with ctypes: keep every member an int64_t.
 *
 * The caller sets sense (0 line, 1 counter-clockwise, -1 clockwise), quadrant (of the code), x and y (of the
 * block, >= 0, not both 0), j and axis (0 = X, 1 = Y), (drift_x, drift_y) = where the controller stands minus
 * where the block should start, and 0 elsewhere; skgsim_run does the rest.
 */
typedef struct {
    int64_t sense, quadrant, x, y, j, axis, drift_x, drift_y;
    int64_t started;
    int64_t px, py;                   /* position, relative to the line's start or the arc's centre */
    int64_t f;                        /* deviation F */
    int64_t counted, steps;
    int64_t f_max, f_min;             /* extremes of F: against the curve from where the block really started */
    int64_t d_max, d_min;             /* the same against the curve from where it should have started */
} skgsim_block;

/* Bits of a drive's port (docs/spec/drive.md). */
enum { SKGSIM_X_STEP = 1, SKGSIM_X_MINUS = 2, SKGSIM_Y_STEP = 4, SKGSIM_Y_MINUS = 8 };

/* Take at most budget steps. When trace is not null, the position after each of them goes into trace[2k], trace[2k +
 * 1]; when port is not null, the value of a drive's port with the pulse up goes into port[k]: the step, and the
 * directions of both axes in the quadrant. STALLED: the count axis does not move any more, so J is never reached. */
int skgsim_run(skgsim_block *block, int64_t budget, int64_t *trace, uint8_t *port);

/* Follow blocks one after the other, each to its end; px and py are then the way from its start. should[2k], should[2k + 1] is
 * the exact way of block k: its error is added to the drift of the next block, beginning with the drift of blocks[0].
 * NULL: all blocks have that drift. Returns count, or the index of the block that STALLED. */
int64_t skgsim_walk(skgsim_block *blocks, int64_t count, const int64_t *should);

#endif
