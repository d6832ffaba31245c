/* The way of the two motors behind port 14H, drawn
 *
 * Steps of 1 um each, as SVG in mm. A staircase of steps becomes a line wherever that lies within 1.5 um of its corners, so
 * that 10 m of way are some ten thousand points. Where the cutting bit is off the way is thin and grey.
 *
 * NOT IMPLEMENTED: more than 2^53 um of way.
 */
#ifndef PATH_H
#define PATH_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

typedef struct path path;

/* A way that begins at (0, 0); NULL without memory. Free with path_free. */
path *path_new(void);
void path_free(path *p);

/* A value of port 14H with a pulse that rises (board.h). False without memory. */
bool path_step(path *p, uint8_t value);

/* Writes the picture and closes the file; false with errno when that fails. */
bool path_draw(path *p, FILE *file);

#endif
