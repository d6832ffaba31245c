/* The SKG board around the small core. See small_board.h. */
#include "small_board.h"

#include <string.h>

enum { TTY_STATUS = 0x10, TTY_DATA, AUX_STATUS, AUX_DATA, DRIVE_PORT, NOBODY = 0xff };
enum { RECEIVED = 0x01, MAY_SEND = 0x02, RTS = 0x60, RTS_HIGH = 0x40 };
enum {
    ASKED_TO_WAIT = 8,
    CLOSE = 500 /* cycles; a wait loop asks again sooner, the firmware between two statements later */
};

/* Counts questions that follow one another closely. */
static void count(const small_board *b, unsigned *asked, uint64_t *asked_at)
{
    uint64_t now = b->cpu.cycles;
    *asked = now - *asked_at <= CLOSE ? *asked + 1 : 0;
    *asked_at = now;
}

static uint8_t tty_status(small_board *b)
{
    bool may_print = b->lines->may_print(b->user);
    count(b, &b->asked, &b->asked_at);
    if (!may_print || b->holds) {
        b->asked = 0;
    }
    if (b->key < 0) {
        b->key = b->lines->key(b->user, small_board_waits(b));
    }
    return (uint8_t)((b->key >= 0 ? RECEIVED : 0) | (may_print ? MAY_SEND : 0));
}

static uint8_t aux_status(small_board *b)
{
    count(b, &b->reader_asked, &b->reader_asked_at);
    if (b->read < 0) {
        b->read = b->lines->reader(b->user);
    }
    return (uint8_t)((b->read >= 0 ? RECEIVED : 0) | (b->lines->may_punch(b->user) ? MAY_SEND : 0));
}

static uint8_t take(int *received, unsigned *asked)
{
    uint8_t c = *received < 0 ? NOBODY : (uint8_t)*received;
    *received = SMALL_BOARD_NONE;
    *asked = 0;
    return c;
}

static uint8_t port_in(void *user, uint8_t port)
{
    small_board *b = user;
    switch (port) {
    case TTY_STATUS:
        return tty_status(b);
    case TTY_DATA:
        return take(&b->key, &b->asked);
    case AUX_STATUS:
        return aux_status(b);
    case AUX_DATA:
        return take(&b->read, &b->reader_asked);
    case DRIVE_PORT:
        b->asked = 0; /* it waits for the feed clock, not for a key */
        return b->lines->drive_in(b->user);
    default:
        return NOBODY;
    }
}

static void port_out(void *user, uint8_t port, uint8_t value)
{
    small_board *b = user;
    switch (port) {
    case TTY_STATUS:
        b->holds = (value & RTS) == RTS_HIGH;
        break;
    case TTY_DATA:
        b->asked = 0;
        b->printed = value & 0x7f;
        b->lines->print(b->user, value & 0x7f);
        break;
    case AUX_DATA:
        b->reader_asked = 0;
        b->lines->punch(b->user, value);
        break;
    case DRIVE_PORT:
        b->latch = value;
        b->lines->drive_out(b->user, value);
        break;
    }
}

void small_board_init(small_board *b, const uint8_t *rom, uint8_t *ram, size_t ram_size, const small_board_lines *lines,
                      void *user)
{
    memset(b, 0, sizeof *b);
    b->lines = lines;
    b->user = user;
    b->key = b->read = SMALL_BOARD_NONE;
    i8080_small_init(&b->cpu, port_in, port_out, b);
    i8080_small_map(&b->cpu, 0, SMALL_BOARD_ROM - 1, rom, NULL);
    i8080_small_map(&b->cpu, SMALL_BOARD_ROM, (uint16_t)(SMALL_BOARD_ROM + ram_size - 1), ram, ram);
}

void small_board_reset(small_board *b)
{
    i8080_small_reset(&b->cpu);
    b->key = b->read = SMALL_BOARD_NONE;
    b->holds = false;
    port_out(b, DRIVE_PORT, 0);
}

void small_board_run(small_board *b, uint64_t cycles)
{
    i8080_small_run(&b->cpu, cycles);
}

bool small_board_waits(const small_board *b)
{
    return b->asked >= ASKED_TO_WAIT;
}

bool small_board_at_prompt(const small_board *b)
{
    return small_board_waits(b) && b->key < 0 && b->printed == '>';
}

void small_board_prompted(small_board *b)
{
    b->printed = '>';
}

bool small_board_waits_for_reader(const small_board *b)
{
    return b->reader_asked >= ASKED_TO_WAIT;
}
