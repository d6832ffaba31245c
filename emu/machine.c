/* The board for tests. See machine.h. */
#include "machine.h"

#include "translations.h"

#include <stdlib.h>
#include <string.h>

enum { RETURN_ADDRESS = 0xfffe };   /* a called subroutine returns to it; no instruction of the ROM is there */

typedef struct {
    uint8_t *bytes;
    size_t length, size;
} record;

struct machine {
    board *board;
    record paper, punch, steps, stepped_at; /* (of the last, bytes of 64-bit numbers) */
};

static void keep(record *r, const void *bytes, size_t length)
{
    if (r->size - r->length < length) {
        size_t size = r->size * 2 + 4096;
        uint8_t *grown = realloc(r->bytes, size);
        if (!grown) {
            abort();                /* a test that loses output must not go on */
        }
        r->bytes = grown;
        r->size = size;
    }
    memcpy(r->bytes + r->length, bytes, length);
    r->length += length;
}

static void keep_paper(void *user, uint8_t byte)
{
    keep(&((machine *)user)->paper, &byte, 1);
}

static void keep_punch(void *user, uint8_t byte)
{
    keep(&((machine *)user)->punch, &byte, 1);
}

static void keep_step(void *user, uint8_t value, uint64_t cycles)
{
    machine *m = user;
    keep(&m->steps, &value, 1);
    keep(&m->stepped_at, &cycles, sizeof cycles);
}

machine *machine_new(const uint8_t *rom, size_t length, unsigned ram_kib, int kind, bool punch_tty, unsigned baud)
{
    machine *m = calloc(1, sizeof *m);
    if (!m || !(m->board = board_new((board_kind)kind, ram_kib))) {
        free(m);
        return NULL;
    }
    m->board->punch_tty |= punch_tty;
    m->board->baud = baud;
    m->board->paper = keep_paper;
    m->board->punch = keep_punch;
    m->board->drive.step = keep_step;
    m->board->user = m;
    board_rom(m->board, rom, length);
    for (size_t i = 0; translations[i] && !i8080_translate(&m->board->cpu, translations[i]); i++) {
    }
    return m;
}

void machine_ports(machine *m, uint8_t tty, uint8_t aux)
{
    m->board->tty_ports = tty;
    m->board->aux_ports = aux;
}

void machine_free(machine *m)
{
    if (m) {
        board_free(m->board);
        free(m->paper.bytes);
        free(m->punch.bytes);
        free(m->steps.bytes);
        free(m->stepped_at.bytes);
        free(m);
    }
}

board *machine_board(machine *m)
{
    return m->board;
}

void machine_sender(machine *m, bool typed, double cps, int lag)
{
    *(typed ? &m->board->typing : &m->board->reading) = (board_sender){ .cps = cps, .lag = lag };
}

uint64_t machine_lost(const machine *m)
{
    return m->board->lost;
}

void machine_feed(machine *m, double hz)
{
    m->board->drive.feed_hz = hz;
}

void machine_stop_at(machine *m, uint64_t step, bool stays)
{
    m->board->drive.stop_at = step;
    m->board->drive.stop_stays = stays;
    m->board->drive.stopped = false;
}

uint64_t machine_hasty_steps(const machine *m)
{
    return m->board->drive.hasty;
}

uint8_t machine_drive(const machine *m)
{
    return m->board->drive.latch;
}

size_t machine_steps(const machine *m, const uint8_t **values, const uint64_t **cycles)
{
    *values = m->steps.bytes;
    *cycles = (const uint64_t *)(const void *)m->stepped_at.bytes;
    return m->steps.length;
}

size_t machine_output(const machine *m, bool punch, const uint8_t **bytes)
{
    const record *r = punch ? &m->punch : &m->paper;
    *bytes = r->bytes;
    return r->length;
}

uint8_t machine_nobody(const machine *m, bool *chip)
{
    *chip = m->board->nobody_chip;
    return m->board->nobody_port;
}

void machine_clear(machine *m)
{
    m->paper.length = m->punch.length = m->steps.length = m->stepped_at.length = 0;
}

void machine_peek(const machine *m, uint16_t address, uint8_t *bytes, size_t length)
{
    for (size_t i = 0; i < length; i++) {
        bytes[i] = i8080_peek(&m->board->cpu, (uint16_t)(address + i));
    }
}

void machine_poke(machine *m, uint16_t address, const uint8_t *bytes, size_t length)
{
    for (size_t i = 0; i < length; i++) {
        i8080_poke(&m->board->cpu, (uint16_t)(address + i), bytes[i]);
    }
}

void machine_get(const machine *m, machine_registers *r)
{
    const i8080 *c = &m->board->cpu;
    *r = (machine_registers){ .a = c->a, .f = c->f, .bc = c->bc, .de = c->de, .hl = c->hl, .sp = c->sp, .pc = c->pc };
}

void machine_set(machine *m, const machine_registers *r)
{
    i8080 *c = &m->board->cpu;
    c->a = r->a;
    c->f = r->f;
    c->bc = r->bc;
    c->de = r->de;
    c->hl = r->hl;
    c->sp = r->sp;
    c->pc = r->pc;
}

void machine_count(const machine *m, machine_counts *counts)
{
    const i8080 *c = &m->board->cpu;
    *counts = (machine_counts){
        .cycles = c->cycles,
        .instructions = c->instructions,
        .fetches_outside = c->fetches_outside,
        .lowest_sp = c->lowest_sp,
        .first_outside = c->first_outside,
        .error_lines = m->board->error_lines,
    };
}

void machine_watch(machine *m, bool on, uint16_t first, uint16_t last)
{
    i8080_watch(&m->board->cpu, on, first, last);
}

bool machine_is_translated(const machine *m)
{
    return m->board->cpu.translation;
}

void machine_interrupt(machine *m, const uint8_t code[3])
{
    i8080_interrupt(&m->board->cpu, code);
}

void machine_break(machine *m, uint16_t address, bool on)
{
    i8080_break(&m->board->cpu, address, on);
}

static machine_end how_it_ended(const machine *m, board_reason reason)
{
    switch (reason) {
    case BOARD_CYCLES:
        return MACHINE_CYCLES;
    case BOARD_BREAK:
        return m->board->cpu.pc == RETURN_ADDRESS ? MACHINE_RETURNED : MACHINE_STOP;
    case BOARD_HALT:
        return MACHINE_HALT;
    default:
        return MACHINE_WAIT;
    }
}

size_t machine_batch(machine *m, const machine_job *job, size_t count, const uint8_t *in, uint8_t *out,
                     uint32_t *cycles, uint8_t *ends, machine_registers *registers)
{
    static const uint8_t return_address[2] = { RETURN_ADDRESS & 0xff, RETURN_ADDRESS >> 8 };
    i8080 *c = &m->board->cpu;
    machine_registers start = job->registers;
    size_t failures = 0;
    start.sp = (uint16_t)(start.sp - 2);
    machine_break(m, RETURN_ADDRESS, true);
    for (size_t i = 0; i < count; i++) {
        machine_poke(m, job->in_address, in + i * job->in_length, job->in_length);
        machine_poke(m, start.sp, return_address, sizeof return_address);
        machine_set(m, &start);
        c->halted = false;
        uint64_t before = c->cycles;
        ends[i] = how_it_ended(m, board_run(m->board, job->max_cycles));
        failures += ends[i] != MACHINE_RETURNED;
        cycles[i] = (uint32_t)(c->cycles - before);
        machine_peek(m, job->out_address, out + i * job->out_length, job->out_length);
        if (registers) {
            machine_get(m, &registers[i]);
        }
    }
    machine_break(m, RETURN_ADDRESS, false);
    return failures;
}
