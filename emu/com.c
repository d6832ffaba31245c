/* A CP/M program on a bare 8080. See com.h. */
#include "com.h"

enum { PORT_END = 0, PORT_BDOS = 1, BDOS_END = 0, BDOS_PRINT = 2, BDOS_PRINT_STRING = 9 };

typedef struct {
    i8080 *cpu;
    FILE *out;
    com_end end;
} console;

static uint8_t port_in(void *user, uint8_t port)
{
    (void)user;
    (void)port;
    return 0xff;
}

static void bdos(console *k)
{
    switch (k->cpu->bc & 0xff) {
    case BDOS_END:
        i8080_stop(k->cpu);
        break;
    case BDOS_PRINT:
        putc(k->cpu->de & 0xff, k->out);
        break;
    case BDOS_PRINT_STRING:
        for (unsigned n = 0; n < I8080_SPACE; n++) {
            uint8_t c = i8080_peek(k->cpu, (uint16_t)(k->cpu->de + n));
            if (c == '$') {
                break;
            }
            putc(c, k->out);
        }
        break;
    default:
        k->end = COM_UNKNOWN;
        i8080_stop(k->cpu);
    }
}

static void port_out(void *user, uint8_t port, uint8_t value)
{
    console *k = user;
    (void)value;
    if (port == PORT_END) {
        i8080_stop(k->cpu);
    } else if (port == PORT_BDOS) {
        bdos(k);
    }
}

com_end com_run(i8080 *c, const uint8_t *program, size_t length, uint64_t cycles, FILE *out)
{
    static const uint8_t low[] = { 0xd3, PORT_END, 0, 0, 0, 0xd3, PORT_BDOS, 0xc9 };
    console k = { .cpu = c, .out = out, .end = COM_ENDED };
    i8080_init(c, port_in, port_out, &k);
    for (unsigned i = 0; i < sizeof low; i++) {
        i8080_poke(c, (uint16_t)i, low[i]);
    }
    for (size_t i = 0; i < length; i++) {
        i8080_poke(c, (uint16_t)(COM_START + i), program[i]);
    }
    c->pc = COM_START;
    c->sp = 0xc8fe;             /* a word of zero: RET ends the program */
    switch (i8080_run(c, cycles)) {
    case I8080_HALTED:
        return COM_HALTED;
    case I8080_STOPPED:
        return k.end;
    default:
        return COM_CYCLES;
    }
}
