/* What the board prints, punches and steps, and where skg80 leaves it: paper, tape, steps, a picture of them, counts */
#ifndef OUTPUT_H
#define OUTPUT_H

#include "session.h"

/* The board's own calls; `user` is the session. */
void output_print(void *user, uint8_t c);
void output_punch(void *user, uint8_t byte);
void output_step(void *user, uint8_t value, uint64_t cycles);

/* Writes the picture of the steps, in place of an earlier one. */
void output_draw(session *s);

/* The board is at its prompt: what has been drawn can be looked at. */
void output_draw_meanwhile(session *s);

/* Gives all output away; false when some of it is lost. */
bool output_flush(session *s);

/* Says what was lost; the exit code. */
int output_failure(const session *s);

/* What a run took, to standard error: of any program on a bare 8080; of the board with its RAM, stack and drive. */
void output_counts(uint64_t cycles, uint64_t instructions);
void output_stats(const session *s);

/* What the drive's user should know at the end. */
void output_drive(const session *s);

#endif
