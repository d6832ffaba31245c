/* Messages of skg80: one line on standard error, and an exit code
 *
 * A message never begins in the middle of a line of the teletype's paper on the same screen.
 */
#ifndef COMPLAIN_H
#define COMPLAIN_H

#include "board.h"

enum { EXIT_ERR = 1, EXIT_USAGE = 2, EXIT_CYCLES = 3 };

/* The board whose paper the user sees on the same screen; NULL: none. */
void complain_beside(const board *b);

/* Ends the paper's line, if it is in the middle of one. */
void complain_end_line(void);

/* Prints `skg80: `, the message and a line end to standard error. The first gives `code` back. */
int complain(int code, const char *format, ...) __attribute__((format(printf, 2, 3)));
void remark(const char *format, ...) __attribute__((format(printf, 1, 2)));

#endif
