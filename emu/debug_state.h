/* The debugger's state: for debug.c, which runs the board, and commands.c, which talks with the operator */
#ifndef DEBUG_STATE_H
#define DEBUG_STATE_H

#include "breaks.h"
#include "calculator.h"
#include "debug.h"

/* The board's work until the operator is asked again. */
typedef enum {
    STOPPED,        /* nothing: the operator is asked now */
    RUNS,           /* until a breakpoint */
    STEPS,          /* so many instructions, */
    OPERATES,       /* or operations of the calculator */
    RETURNS         /* until the stack pointer is above `stack` */
} mode;

struct debug {
    board *board;
    const symbols *names;
    calculator *calculator;         /* NULL: its names are not known */
    FILE *trace;
    int trace_failed;
    breaks breaks;
    mode mode;
    uint64_t count;                 /* of STEPS and OPERATES */
    uint16_t stack;                 /* of RETURNS */
    bool left;
};

/* Asks the operator until the board is to go on: then the mode is another than STOPPED. */
void debug_talk(debug *d);

#endif
