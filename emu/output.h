/* Output of the board and its files: paper, tape, steps, a picture of them, counts */
#ifndef OUTPUT_H
#define OUTPUT_H

#include "session.h"

/* The board's own calls; `user` is the session. */
void output_print(void *user, uint8_t c);
void output_punch(void *user, uint8_t byte);
void output_step(void *user, uint8_t value, uint64_t cycles);

/* At the prompt: what was written so far has its names (outfile.h), and the picture is one of all steps so far. */
void output_settle(session *s);

/* At the end: the same for all of it, if the board was run at all; else the files before are there. Reports the parts
 * that are left; false: one of them is a tape. */
bool output_end(session *s);

/* Flushes all output; false when some of it is lost. */
bool output_flush(session *s);

/* Reports lost output; returns the exit code. */
int output_failure(const session *s);

/* Print the counts of a run to standard error: of any program on a bare 8080; of the board with its RAM, stack and
 * drive. */
void output_counts(uint64_t cycles, uint64_t instructions);
void output_stats(const session *s);

/* Reports a drive without steps, and hasty steps (drive.h). */
void output_drive(const session *s);

#endif
