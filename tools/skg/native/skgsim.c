#include "skgsim.h"

#include <stddef.h>

/* One quadrant in which a block moves: a step with F >= 0 goes (in_x, in_y), one with F < 0 (out_x, out_y).
 *
 * Counter-clockwise in quadrant 1 the step towards the inside is -X and the other one +Y; each further quadrant
 * turns both by 90 degrees. Clockwise it is the mirror image in the line x = y (see tape.py, start_quadrant).
 * A line turns the same way from quadrant 1, where F >= 0 (on the line or left of it) steps +X, F < 0 steps +Y. */
typedef struct {
    int in_x, in_y, out_x, out_y;
} steps;

static steps steps_in(int64_t quadrant, int64_t sense)
{
    int turns = (int)(sense < 0 ? 5 - quadrant : quadrant - 1) % 4;
    steps s = sense ? (steps){ -1, 0, 0, 1 } : (steps){ 1, 0, 0, 1 };
    for (; turns > 0; turns--)
        s = (steps){ -s.in_y, s.in_x, -s.out_y, s.out_x };
    return sense < 0 ? (steps){ s.in_y, s.in_x, s.out_y, s.out_x } : s;
}

/* Signs of the coordinates in a quadrant. */
static int64_t sign_x(int64_t quadrant)
{
    return quadrant == 1 || quadrant == 4 ? 1 : -1;
}
static int64_t sign_y(int64_t quadrant)
{
    return quadrant <= 2 ? 1 : -1;
}

/* The value of a drive's port: the directions of the two possible steps; port_step adds the step that is made. */
static uint8_t directions(steps s)
{
    return (uint8_t)((s.in_x + s.out_x < 0 ? SKGSIM_X_MINUS : 0) | (s.in_y + s.out_y < 0 ? SKGSIM_Y_MINUS : 0));
}
static uint8_t port_step(steps s, int x)
{
    return (uint8_t)(directions(s) | (x ? SKGSIM_X_STEP : SKGSIM_Y_STEP));
}

static int64_t larger(int64_t a, int64_t b)
{
    return a > b ? a : b;
}
static int64_t smaller(int64_t a, int64_t b)
{
    return a < b ? a : b;
}

/* The controller knows that it leaves a quadrant when the coordinate that shrinks there has reached 0.
 * The loop below runs within one quadrant: F changes by a constant on a line; on an arc a step along an axis
 * whose coordinate is p changes it by 2sp + 1 (s = +-1, the step), which a step itself changes by 2. */
static inline int run(skgsim_block *b, int64_t budget, int64_t *trace, uint8_t *port, int is_line)
{
    const int64_t end_x = is_line ? sign_x(b->quadrant) * b->x : 0;
    const int64_t end_y = is_line ? sign_y(b->quadrant) * b->y : 0;
    /* J is at most four radii, in about twice as many steps; a controller that takes more is stuck. */
    const int64_t limit = 16 * (b->x + b->y) + 64;
    if (!b->started) {
        b->started = 1;
        if (!is_line) {
            b->px = sign_x(b->quadrant) * b->x;
            b->py = sign_y(b->quadrant) * b->y;
        }
        b->d_max = b->d_min =
            is_line ? b->drift_y * end_x - b->drift_x * end_y
                    : 2 * (b->drift_x * b->px + b->drift_y * b->py) + b->drift_x * b->drift_x + b->drift_y * b->drift_y;
    }
    while (b->counted < b->j) {
        const steps s = steps_in(b->quadrant, b->sense);
        const uint8_t port_in = port_step(s, s.in_x), port_out = port_step(s, s.out_x);
        const int64_t in_counts = b->axis ? s.in_y != 0 : s.in_x != 0;
        int64_t px = b->px, py = b->py, f = b->f, counted = b->counted, taken = 0;
        int64_t f_max = b->f_max, f_min = b->f_min, d_max = b->d_max, d_min = b->d_min;
        /* Changes of F by the next step inside or outside; a step adds `grow` to its own. */
        int64_t f_in, f_out, grow, distance;
        /* The deviation against the intended curve is d = f + d_rest; d_rest changes by a constant per step. */
        int64_t d_rest, d_in, d_out;
        if (is_line) {
            f_in = s.in_y * end_x - s.in_x * end_y;
            f_out = s.out_y * end_x - s.out_x * end_y;
            grow = 0;
            distance = INT64_MAX;
            d_rest = b->drift_y * end_x - b->drift_x * end_y;
            d_in = d_out = 0;
        } else {
            f_in = 2 * (s.in_x * px + s.in_y * py) + 1;
            f_out = 2 * (s.out_x * px + s.out_y * py) + 1;
            grow = 2;
            distance = s.in_x ? px * -s.in_x : py * -s.in_y;
            d_rest = 2 * (b->drift_x * px + b->drift_y * py) + b->drift_x * b->drift_x + b->drift_y * b->drift_y;
            d_in = 2 * (b->drift_x * s.in_x + b->drift_y * s.in_y);
            d_out = 2 * (b->drift_x * s.out_x + b->drift_y * s.out_y);
        }
        const int64_t room = smaller(budget, limit - b->steps);
        while (taken < room && counted < b->j) {
            if (port != NULL)
                *port++ = f >= 0 ? port_in : port_out;
            if (f >= 0) {
                f += f_in;
                f_in += grow;
                px += s.in_x;
                py += s.in_y;
                counted += in_counts;
                d_rest += d_in;
                distance--;
            } else {
                f += f_out;
                f_out += grow;
                px += s.out_x;
                py += s.out_y;
                counted += !in_counts;
                d_rest += d_out;
            }
            f_max = larger(f_max, f);
            f_min = smaller(f_min, f);
            d_max = larger(d_max, f + d_rest);
            d_min = smaller(d_min, f + d_rest);
            if (trace != NULL) {
                *trace++ = px;
                *trace++ = py;
            }
            taken++;
            if (distance == 0)
                break;
        }
        b->px = px;
        b->py = py;
        b->f = f;
        b->counted = counted;
        b->f_max = f_max;
        b->f_min = f_min;
        b->d_max = d_max;
        b->d_min = d_min;
        b->steps += taken;
        budget -= taken;
        if (distance == 0)
            b->quadrant = (b->quadrant + (b->sense > 0 ? 0 : 2)) % 4 + 1;
        if (counted < b->j) {
            if (b->steps >= limit)
                return SKGSIM_STALLED;
            if (budget <= 0)
                return SKGSIM_MORE;
        }
    }
    return SKGSIM_DONE;
}

int skgsim_run(skgsim_block *block, int64_t budget, int64_t *trace, uint8_t *port)
{
    /* Two copies of the loop, each with its kind of block folded in. */
    return block->sense ? run(block, budget, trace, port, 0) : run(block, budget, trace, port, 1);
}

int64_t skgsim_walk(skgsim_block *blocks, int64_t count, const int64_t *should)
{
    int64_t x = count ? blocks->drift_x : 0, y = count ? blocks->drift_y : 0;
    for (int64_t k = 0; k < count; k++) {
        skgsim_block *b = &blocks[k];
        b->drift_x = x;
        b->drift_y = y;
        const int64_t from_x = b->sense ? sign_x(b->quadrant) * b->x : 0;
        const int64_t from_y = b->sense ? sign_y(b->quadrant) * b->y : 0;
        if (skgsim_run(b, INT64_MAX, NULL, NULL) == SKGSIM_STALLED)
            return k;
        b->px -= from_x;
        b->py -= from_y;
        if (should != NULL) {
            x += b->px - should[2 * k];
            y += b->py - should[2 * k + 1];
        }
    }
    return count;
}
