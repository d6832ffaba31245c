/* The way of the two motors, drawn. See path.h. */
#include "path.h"

#include "board.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>

enum { MARGIN = 20 }; /* of the picture, a part of its size */

#define WITHIN 1.5 /* um */

typedef struct {
    int64_t x, y;
    bool cuts; /* the way that ends here */
} place;

struct path {
    place *places; /* the corners that are kept */
    size_t count, size;
    place here;
    double low, high; /* directions from the last corner that pass all steps since within WITHIN; low > high: any */
};

path *path_new(void)
{
    path *p = calloc(1, sizeof *p);
    if (p) {
        p->low = 1;
        p->places = calloc(1, sizeof *p->places);
        p->count = p->size = 1;
    }
    if (p && !p->places) {
        free(p);
        return NULL;
    }
    return p;
}

void path_free(path *p)
{
    if (p) {
        free(p->places);
        free(p);
    }
}

/* Keeps the present place as a corner. */
static bool keep(path *p)
{
    if (p->count == p->size) {
        size_t size = p->size * 2;
        place *grown = realloc(p->places, size * sizeof *grown);
        if (!grown) {
            return false;
        }
        p->places = grown;
        p->size = size;
    }
    p->places[p->count++] = p->here;
    p->low = 1;
    p->high = 0;
    return true;
}

/* An angle that lies within half a turn of `about`. */
static double near(double angle, double about)
{
    return angle - 2 * M_PI * round((angle - about) / (2 * M_PI));
}

bool path_step(path *p, uint8_t value)
{
    place next = p->here;
    bool fits = true;
    next.x += value & BOARD_STEP_X ? value & BOARD_MINUS_X ? -1 : 1 : 0;
    next.y += value & BOARD_STEP_Y ? value & BOARD_MINUS_Y ? -1 : 1 : 0;
    next.cuts = value & BOARD_CUTS;
    if (next.cuts != p->here.cuts) {
        fits = keep(p);
    }
    for (int tries = 0; tries < 2; tries++) {
        const place *corner = &p->places[p->count - 1];
        double x = (double)(next.x - corner->x), y = (double)(next.y - corner->y), far = hypot(x, y);
        if (far <= WITHIN) {
            break;
        }
        double to = atan2(y, x), half = asin(WITHIN / far);
        if (p->low > p->high) {
            p->low = to - half;
            p->high = to + half;
            break;
        }
        to = near(to, (p->low + p->high) / 2);
        if (to >= p->low && to <= p->high) {
            p->low = fmax(p->low, to - half);
            p->high = fmin(p->high, to + half);
            break;
        }
        fits = fits && keep(p);
    }
    p->here = next;
    return fits;
}

/* The ways that are cut, or the others, as one path element. */
static void draw_ways(const path *p, FILE *file, bool cuts)
{
    fprintf(file, "<path class=\"%s\" d=\"", cuts ? "cut" : "move");
    for (size_t i = 1; i < p->count; i++) {
        const place *from = &p->places[i - 1], *to = &p->places[i];
        if (to->cuts != cuts) {
            continue;
        }
        if (i == 1 || from->cuts != cuts) {
            fprintf(file, "M%.3f %.3f", (double)from->x / 1000, (double)from->y / 1000);
        }
        fprintf(file, "%sL%.3f %.3f", i % 16 ? "" : "\n", (double)to->x / 1000, (double)to->y / 1000);
    }
    fputs("\"/>\n", file);
}

bool path_draw(path *p, FILE *file)
{
    int64_t left = 0, right = 0, bottom = 0, top = 0;
    bool fits = keep(p);
    for (size_t i = 0; i < p->count; i++) {
        const place *at = &p->places[i];
        left = at->x < left ? at->x : left;
        right = at->x > right ? at->x : right;
        bottom = at->y < bottom ? at->y : bottom;
        top = at->y > top ? at->y : top;
    }
    double width = (double)(right - left) / 1000, height = (double)(top - bottom) / 1000;
    double margin = fmax(fmax(width, height) / MARGIN, 0.01);
    width += 2 * margin;
    height += 2 * margin;
    fprintf(file,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.3fmm\" height=\"%.3fmm\" viewBox=\"%.3f %.3f %.3f %.3f\">\n"
            "<style>path{fill:none;vector-effect:non-scaling-stroke;stroke-linejoin:round}"
            ".cut{stroke:#000;stroke-width:1.5px}.move{stroke:#999;stroke-width:.6px}</style>\n"
            "<g transform=\"scale(1,-1)\">\n",
            width, height, (double)left / 1000 - margin, -(double)top / 1000 - margin, width, height);
    draw_ways(p, file, false);
    draw_ways(p, file, true);
    fputs("</g>\n</svg>\n", file);
    bool written = !ferror(file);
    if (fclose(file)) {
        return false;
    }
    errno = fits ? EIO : ENOMEM;
    return written && fits;
}
