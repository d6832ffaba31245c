/* Shared by the 8080 cores: the host's port functions, the reason of a run's end */
#ifndef I8080_HOST_H
#define I8080_HOST_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { I8080_SPACE = 0x10000 };

/* The reason of a run's end. */
typedef enum {
    I8080_CYCLES,   /* the cycles are used up */
    I8080_HALTED,   /* HLT, and no interrupt to end it */
    I8080_STOPPED,  /* i8080_stop() was called, from a port function as a rule */
    I8080_BREAK     /* PC is at a breakpoint; the instruction there is not yet carried out */
} i8080_reason;

typedef uint8_t i8080_in_fn(void *user, uint8_t port);
typedef void i8080_out_fn(void *user, uint8_t port, uint8_t value);

#endif
