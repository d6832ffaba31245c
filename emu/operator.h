/* The operator's work: a part LOADed and RUN, or a person at the other end of a terminal, pipe or pseudo-terminal */
#ifndef OPERATOR_H
#define OPERATOR_H

#include "session.h"

/* LOAD, RUN or END, answers to INPUT (lines, ended by a NUL); DRIVE 1, a key at each stop. Returns the exit code. */
int operator_part(session *s, const char *answers);

/* Lets the operator work until he leaves or his input has ended. Returns the exit code. */
int operator_terminal(session *s);

#endif
