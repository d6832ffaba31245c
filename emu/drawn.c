/* The drive's steps as a drawing. See drawn.h. */
#include "drawn.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>

enum { UM = 1000 };             /* in a mm */

/* Widths of lines and margin, as parts of the drawing's larger side. */
#define CUT_WIDTH 0.003
#define MOVE_WIDTH 0.001
#define MARGIN 0.03

typedef struct {
    int64_t x, y;               /* um */
} place;

/* A corner of the drawing: `pen_down`: the wire cuts from here on; `first`: a new line begins here. */
typedef struct {
    place at;
    bool pen_down, first;
} corner;

typedef struct {
    double x, y;
} vector;

/* The line that is being drawn goes from the last corner to `here`. It may end at any place in a cone as seen from that
 * corner, in which every place passed since is near enough. */
struct drawn {
    corner *corners;
    size_t count, size;
    place here, low, high; /* low, high: the drawing's extent */
    bool drawing, pen_down;
    bool has_cone;
    vector right, left; /* its sides, of length 1 */
    double furthest; /* from the corner */
    uint64_t steps;
};

drawn *drawn_new(void)
{
    return calloc(1, sizeof(drawn));
}

void drawn_free(drawn *d)
{
    if (d) {
        free(d->corners);
        free(d);
    }
}

static double cross(vector a, vector b)
{
    return a.x * b.y - a.y * b.x;
}

/* Makes `here` a corner. */
static bool set_corner(drawn *d, bool first)
{
    if (d->count == d->size) {
        size_t size = d->size * 2 + 256;
        corner *grown = realloc(d->corners, size * sizeof *grown);
        if (!grown) {
            return false;
        }
        d->corners = grown;
        d->size = size;
    }
    d->corners[d->count++] = (corner){ d->here, d->pen_down, first };
    d->has_cone = false;
    d->furthest = 0;
    return true;
}

static vector from_corner(const drawn *d, place to)
{
    const place *from = &d->corners[d->count - 1].at;
    return (vector){ (double)(to.x - from->x), (double)(to.y - from->y) };
}

/* Tells whether the line can go on to the place `way` from its corner, with every place before it near enough. */
static bool fits(const drawn *d, vector way, double distance)
{
    if (distance < d->furthest) {
        return false; /* the way turns back */
    }
    return !d->has_cone || (cross(d->right, way) >= 0 && cross(way, d->left) >= 0);
}

/* Narrows the cone to the lines that come near enough to the place just reached. */
static void narrow(drawn *d, vector way, double distance)
{
    d->furthest = fmax(d->furthest, distance);
    if (distance <= DRAWN_TOLERANCE) {
        return;
    }
    double sine = DRAWN_TOLERANCE / distance, cosine = sqrt(1 - sine * sine);
    vector u = { way.x / distance, way.y / distance };
    vector right = { u.x * cosine + u.y * sine, u.y * cosine - u.x * sine };
    vector left = { u.x * cosine - u.y * sine, u.y * cosine + u.x * sine };
    if (!d->has_cone || cross(d->right, right) > 0) {
        d->right = right;
    }
    if (!d->has_cone || cross(d->left, left) < 0) {
        d->left = left;
    }
    d->has_cone = true;
}

static void widen(drawn *d)
{
    d->low.x = d->here.x < d->low.x ? d->here.x : d->low.x;
    d->low.y = d->here.y < d->low.y ? d->here.y : d->low.y;
    d->high.x = d->here.x > d->high.x ? d->here.x : d->high.x;
    d->high.y = d->here.y > d->high.y ? d->here.y : d->high.y;
}

bool drawn_step(drawn *d, uint8_t value)
{
    bool pen_down = value & DRIVE_CUTTING;
    if (!d->drawing || pen_down != d->pen_down) {
        if (d->drawing && !set_corner(d, false)) {
            return false;
        }
        d->pen_down = pen_down;
        if (!set_corner(d, true)) {
            return false;
        }
        d->drawing = true;
    }
    place next = d->here;
    if (value & DRIVE_X_STEP) {
        next.x += value & DRIVE_X_MINUS ? -1 : 1;
    }
    if (value & DRIVE_Y_STEP) {
        next.y += value & DRIVE_Y_MINUS ? -1 : 1;
    }
    vector way = from_corner(d, next);
    double distance = hypot(way.x, way.y);
    if (!fits(d, way, distance)) {
        if (!set_corner(d, false)) {
            return false;
        }
        way = from_corner(d, next);
        distance = hypot(way.x, way.y);
    }
    narrow(d, way, distance);
    d->here = next;
    widen(d);
    d->steps++;
    return true;
}

/* Writes one path of all lines with the pen down, or up: a line's beginning as a position, the rest as distances. */
static void write_path(const drawn *d, bool pen_down, FILE *out)
{
    place at = { 0, 0 };
    fprintf(out, "<path class=\"%s\" d=\"", pen_down ? "cut" : "move");
    for (size_t i = 0; i <= d->count; i++) {
        /* (the line that is being drawn ends here) */
        corner next = i < d->count ? d->corners[i] : (corner){ d->here, d->pen_down, false };
        if (next.pen_down != pen_down) {
            continue;
        }
        if (next.first) {
            fprintf(out, "M%" PRId64 " %" PRId64, next.at.x, next.at.y);
        } else {
            fprintf(out, "l%" PRId64 " %" PRId64, next.at.x - at.x, next.at.y - at.y);
        }
        at = next.at;
    }
    fputs("\"/>\n", out);
}

bool drawn_write(const drawn *d, FILE *out)
{
    double width = (double)(d->high.x - d->low.x), height = (double)(d->high.y - d->low.y);
    double larger = fmax(fmax(width, height), 1), margin = larger * MARGIN;
    width += 2 * margin;
    height += 2 * margin;
    fprintf(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.3fmm\" height=\"%.3fmm\" viewBox=\"%.3f %.3f %.3f %.3f\">\n"
        "<title>%" PRIu64 " steps</title>\n"
        "<style>path{fill:none;stroke-linejoin:round}.cut{stroke:#000;stroke-width:%.0f}"
        ".move{stroke:#999;stroke-width:%.0f}</style>\n"
        "<g transform=\"scale(.001 -.001)\">\n",
        width / UM, height / UM, ((double)d->low.x - margin) / UM, (-(double)d->high.y - margin) / UM, width / UM,
        height / UM, d->steps, fmax(larger * CUT_WIDTH, 1), fmax(larger * MOVE_WIDTH, 1));
    if (d->drawing) {
        write_path(d, false, out);
        write_path(d, true, out);
    }
    fputs("</g>\n</svg>\n", out);
    return !fflush(out) && !ferror(out);
}
