/* The 3B controller of the page: the functions of walk.wasm that walk.ts calls. One block at a time; all lengths in um,
 * as doubles, since 64-bit integers are slow in JavaScript. The stepping itself is skg sim's. */
#include "../../tools/skg/native/skgsim.h"

#define EXPORT(name) __attribute__((export_name(#name)))

static skgsim_block now;

/* The block as tape.ts has it; drift: where the controller stands minus where the block should start. */
EXPORT(walk_block)
void walk_block(int sense, int quadrant, double x, double y, double j, int axis, double drift_x, double drift_y)
{
    now = (skgsim_block){ .sense = sense,
                          .quadrant = quadrant,
                          .x = (int64_t)x,
                          .y = (int64_t)y,
                          .j = (int64_t)j,
                          .axis = axis,
                          .drift_x = (int64_t)drift_x,
                          .drift_y = (int64_t)drift_y };
}

/* Takes at most so many steps: 0 done, 1 more to come, 2 the block never ends. */
EXPORT(walk_run) int walk_run(double budget)
{
    return skgsim_run(&now, (int64_t)budget, 0, 0);
}

/* The position, relative to the line's start or the arc's centre, and the steps taken. */
EXPORT(walk_x) double walk_x(void)
{
    return (double)now.px;
}
EXPORT(walk_y) double walk_y(void)
{
    return (double)now.py;
}
EXPORT(walk_steps) double walk_steps(void)
{
    return (double)now.steps;
}

/* Extremes of F, against the curve from where the block really started and from where it should have. */
EXPORT(walk_f_max) double walk_f_max(void)
{
    return (double)now.f_max;
}
EXPORT(walk_f_min) double walk_f_min(void)
{
    return (double)now.f_min;
}
EXPORT(walk_d_max) double walk_d_max(void)
{
    return (double)now.d_max;
}
EXPORT(walk_d_min) double walk_d_min(void)
{
    return (double)now.d_min;
}
