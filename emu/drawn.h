/* The drive's steps as a drawing: an SVG in mm, true to size, from the steps alone
 *
 * Cuts are black, moves (cutting bit off) thin and grey. Steps are put together to lines as they come: no place that
 * was passed lies further than DRAWN_TOLERANCE from the line drawn, and the ends of cuts and moves are exact. So a path
 * of 10 m makes a file of some hundred KB; its numbers are whole micrometres.
 *
 * NOT IMPLEMENTED: when something was drawn, and how often one line was gone over.
 */
#ifndef DRAWN_H
#define DRAWN_H

#include "drive.h"

#include <stdio.h>

#define DRAWN_TOLERANCE 2.0         /* um: steps lie up to 1 um beside the true line, on both sides */

typedef struct drawn drawn;

/* An empty sheet; NULL without memory. Free with drawn_free. */
drawn *drawn_new(void);
void drawn_free(drawn *d);

/* One step, as the port has it with the pulse up. False without memory. */
bool drawn_step(drawn *d, uint8_t value);

/* Writes the SVG of all steps so far; false when that fails (errno). */
bool drawn_write(const drawn *d, FILE *out);

#endif
