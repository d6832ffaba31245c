/* The board of the page: the functions of board.wasm that board.ts calls
 *
 * One board for the visitor, and a second one for copies of its memory (`which` 0 and 1). Paper and punch are kept
 * until they are taken. For every line on the punch (a block, D, DD) it records the line of the program that made it
 * and the wire's position behind it.
 *
 * Both come from the firmware's cells and labels (page_names): at `element` an element of the route becomes the present
 * one, and the running line is its line; while the wire goes along it (from `along` until that returns), output of the
 * punch belongs to that line. All other output - the way from the start hole and back, from hole to hole, D, DD -
 * belongs to the running line. Line 0: a direct statement. Beside the punched bytes stand marks, each at its place
 * between two of them: at `run` a run begins, at `ready` the board comes to its prompt, at `save` it gives its program
 * to the punch, and the reset button is one.
 *
 * The page's debugger stops at addresses of machine code or byte-code (page_stop_at), and goes on step by step
 * (page_step).
 */
#include "../../emu/board.h"
#include "../../emu/breaks.h"

#include <stdlib.h>
#include <string.h>

#define EXPORT(name) __attribute__((export_name(#name)))

enum { BOARDS = 2, RAM_KIB = 8, RAM = RAM_KIB * 1024, FLOAT = 5, EXCESS = 128, BUFFER_STEP = 4096 };

typedef struct {
    uint8_t *bytes;
    size_t length, size;
} record;

/* The things beside the punched bytes: what begins there, in the order of NOTES in board.ts */
enum { A_LINE, A_RUN, A_PROMPT, A_SAVE, A_RESET };

/* A note beside the punched bytes: its place among them, what it is, the program line that made a line on the punch
 * (or at which a run begins, 0: the first one), and the wire's position behind it (um). */
typedef struct {
    double at, what, line, x, y;
} note;

static struct held {
    board *board;
    record paper, punch, notes;
    bool punching;              /* in the middle of a line of the punch */
    uint16_t element_line;      /* of the present element of the route */
    bool along;                 /* the wire goes along it */
    uint16_t back;              /* its return address: the way ends there */
    breaks stops;               /* of the page's debugger */
} boards[BOARDS];

static record buffer;           /* bytes for the next call */

static struct {
    uint16_t current, direct, element, along, run, ready, save, wire, operation;
} names;

static bool room(record *r, size_t length)
{
    if (r->length + length > r->size) {
        size_t size = r->size + r->size / 2 + length + BUFFER_STEP;
        uint8_t *grown = realloc(r->bytes, size);
        if (!grown) {
            return false;
        }
        r->bytes = grown;
        r->size = size;
    }
    return true;
}

static void keep(record *r, const void *bytes, size_t length)
{
    if (!room(r, length)) {
        __builtin_trap();       /* a page that loses tape must not go on */
    }
    memcpy(r->bytes + r->length, bytes, length);
    r->length += length;
}

static uint16_t word_at(const struct held *h, uint16_t address)
{
    const i8080 *c = &h->board->cpu;
    return (uint16_t)(i8080_peek(c, address) | i8080_peek(c, (uint16_t)(address + 1)) << 8);
}

/* A float of the firmware's: excess, then the mantissa with the sign in place of its first bit. */
static double float_at(const struct held *h, uint16_t address)
{
    uint8_t bytes[FLOAT];
    for (unsigned i = 0; i < FLOAT; i++) {
        bytes[i] = i8080_peek(&h->board->cpu, (uint16_t)(address + i));
    }
    if (!bytes[0]) {
        return 0;
    }
    double value = (bytes[1] | 0x80u) << 24 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 8 | bytes[4];
    for (int excess = bytes[0] - EXCESS - 32; excess; excess += excess < 0 ? 1 : -1) {
        value = excess < 0 ? value / 2 : value * 2;
    }
    return bytes[1] & 0x80 ? -value : value;
}

static uint16_t running_line(const struct held *h)
{
    return i8080_peek(&h->board->cpu, (uint16_t)(names.direct + 1)) ? word_at(h, names.current) : 0;
}

/* Tells whether the board stops at an address, for the page or for its debugger. */
static bool is_marked(const struct held *h, uint16_t address)
{
    return address == names.element || address == names.along || address == names.run || address == names.ready
           || address == names.save || (h->along && address == h->back) || breaks_has(&h->stops, address)
           || (h->stops.count && address == names.operation);
}

/* Tells whether the board is at a breakpoint, in machine code or in byte-code. */
static bool at_stop(const struct held *h)
{
    const i8080 *c = &h->board->cpu;
    return breaks_has(&h->stops, c->pc) || (c->pc == names.operation && breaks_has(&h->stops, c->bc));
}

static void print(void *user, uint8_t byte)
{
    keep(&((struct held *)user)->paper, &byte, 1);
}

static void punch(void *user, uint8_t byte)
{
    struct held *h = user;
    if (!h->punching && byte >= ' ') {
        note n = { .at = (double)h->punch.length,
                   .what = A_LINE,
                   .line = h->along ? h->element_line : running_line(h),
                   .x = float_at(h, names.wire),
                   .y = float_at(h, (uint16_t)(names.wire + FLOAT)) };
        keep(&h->notes, &n, sizeof n);
    }
    keep(&h->punch, &byte, 1);
    h->punching = byte >= ' ';
}

/* A mark; a line that is not whole in front of it ends there. */
static void mark(struct held *h, int what, uint16_t line)
{
    note n = { .at = (double)h->punch.length, .what = what, .line = line };
    keep(&h->notes, &n, sizeof n);
    h->punching = false;
}

/* ---- called by board.ts ---- */

/* A buffer for so many bytes of the next call; 0 without memory. */
EXPORT(page_buffer) uint8_t *page_buffer(uint32_t length)
{
    buffer.length = 0;
    return room(&buffer, length) ? buffer.bytes : NULL;
}

/* Addresses: cell of the running line; cell whose high byte is 0 for a direct statement; the five labels (at `run` DE is
 * the line at which the run begins, or 0); the first of two floats, the wire's position; the label at which the
 * calculator takes its next operation, the byte at BC. */
EXPORT(page_names)
void page_names(uint32_t current, uint32_t direct, uint32_t element, uint32_t along, uint32_t run, uint32_t ready,
                uint32_t save, uint32_t wire, uint32_t operation)
{
    names.current = (uint16_t)current;
    names.direct = (uint16_t)direct;
    names.element = (uint16_t)element;
    names.along = (uint16_t)along;
    names.run = (uint16_t)run;
    names.ready = (uint16_t)ready;
    names.save = (uint16_t)save;
    names.wire = (uint16_t)wire;
    names.operation = (uint16_t)operation;
}

/* A board with the ROM in the buffer; false without memory. */
EXPORT(page_board) bool page_board(uint32_t which, uint32_t length)
{
    struct held *h = &boards[which];
    board_free(h->board);
    h->board = board_new(BOARD_6850, RAM_KIB);
    if (!h->board) {
        return false;
    }
    h->board->paper = print;
    h->board->punch = punch;
    h->board->user = h;
    board_rom(h->board, buffer.bytes, length);
    const uint16_t followed[] = { names.element, names.along, names.run, names.ready, names.save };
    for (unsigned i = 0; i < sizeof followed / sizeof *followed; i++) {
        i8080_break(&h->board->cpu, followed[i], true);
    }
    return true;
}

EXPORT(page_reset) void page_reset(uint32_t which)
{
    boards[which].along = false;
    mark(&boards[which], A_RESET, 0);
    board_reset(boards[which].board);
}

EXPORT(page_type) bool page_type(uint32_t which, uint32_t length)
{
    return board_type(boards[which].board, buffer.bytes, length);
}

EXPORT(page_press) bool page_press(uint32_t which, uint32_t key)
{
    return board_press(boards[which].board, (uint8_t)key);
}

EXPORT(page_forget) void page_forget(uint32_t which)
{
    board_forget_typed(boards[which].board);
}

EXPORT(page_tape) bool page_tape(uint32_t which, uint32_t length)
{
    return board_tape(boards[which].board, buffer.bytes, length);
}

EXPORT(page_take_tape) void page_take_tape(uint32_t which)
{
    board_take_tape(boards[which].board);
}

EXPORT(page_idle) bool page_idle(uint32_t which)
{
    return board_idle(boards[which].board);
}

EXPORT(page_silence) double page_silence(uint32_t which)
{
    return (double)board_reader_silence(boards[which].board);
}

EXPORT(page_baud) void page_baud(uint32_t which, uint32_t baud)
{
    boards[which].board->baud = baud;
}

EXPORT(page_cycles) double page_cycles(uint32_t which)
{
    return (double)boards[which].board->cpu.cycles;
}

/* Follows the firmware at its labels: a run begins or is over, a program goes out, the present element changes, the way
 * along it begins or ends. */
static void follow(struct held *h)
{
    i8080 *c = &h->board->cpu;
    if (h->along && c->pc == h->back) {
        h->along = false;
        i8080_break(c, h->back, is_marked(h, h->back));
    }
    if (c->pc == names.run) {
        h->along = false;
        mark(h, A_RUN, c->de);
    } else if (c->pc == names.ready) {
        mark(h, A_PROMPT, 0);
    } else if (c->pc == names.save) {
        mark(h, A_SAVE, 0);
    } else if (c->pc == names.element) {
        h->element_line = running_line(h);
        h->along = false; /* (an error may have left it true) */
    } else if (c->pc == names.along) {
        h->along = true;
        h->back = word_at(h, c->sp);
        i8080_break(c, h->back, true);
    }
}

/* Carries out the instruction at PC, marked or not. */
static board_reason go_over(struct held *h)
{
    i8080 *c = &h->board->cpu;
    uint16_t here = c->pc;
    follow(h);
    i8080_break(c, here, false);
    board_reason reason = board_run(h->board, 1);
    i8080_break(c, here, is_marked(h, here));
    return reason;
}

/* Runs as board_run does; BOARD_BREAK: at a breakpoint of the debugger. */
EXPORT(page_run) uint32_t page_run(uint32_t which, double cycles)
{
    struct held *h = &boards[which];
    i8080 *c = &h->board->cpu;
    uint64_t end = c->cycles + (uint64_t)cycles;
    for (;;) {
        board_reason reason = board_run(h->board, end > c->cycles ? end - c->cycles : 0);
        if (reason != BOARD_BREAK || at_stop(h)) {
            return reason;
        }
        reason = go_over(h);
        if (reason != BOARD_CYCLES && reason != BOARD_BREAK) {
            return reason;
        }
    }
}

/* Sets or deletes a breakpoint; false when there are too many. */
EXPORT(page_stop_at) bool page_stop_at(uint32_t which, uint32_t address, bool stops)
{
    struct held *h = &boards[which];
    i8080 *c = &h->board->cpu;
    bool done = stops ? breaks_set(&h->stops, (uint16_t)address) : breaks_delete(&h->stops, (uint16_t)address);
    i8080_break(c, (uint16_t)address, is_marked(h, (uint16_t)address));
    i8080_break(c, names.operation, is_marked(h, names.operation));
    return done;
}

/* Runs one instruction, or to the calculator's next operation, or until the stack pointer is above `stack`; not past a
 * breakpoint. BOARD_BREAK: done; else as page_run. */
EXPORT(page_step) uint32_t page_step(uint32_t which, uint32_t how, uint32_t stack, double cycles)
{
    enum { INSTRUCTION, OPERATION, RETURN };
    struct held *h = &boards[which];
    const i8080 *c = &h->board->cpu;
    uint64_t end = c->cycles + (uint64_t)cycles;
    do {
        board_reason reason = go_over(h);
        if (how == INSTRUCTION || (how == OPERATION && c->pc == names.operation) || (how == RETURN && c->sp > stack)
            || at_stop(h)) {
            return BOARD_BREAK;
        }
        if (reason != BOARD_CYCLES && reason != BOARD_BREAK) {
            return reason;
        }
    } while (c->cycles < end);
    return BOARD_CYCLES;
}

/* A, F, then BC, DE, HL, SP, PC, the high byte first, into the buffer. */
EXPORT(page_registers) uint8_t *page_registers(uint32_t which)
{
    const i8080 *c = &boards[which].board->cpu;
    const uint16_t words[] = { (uint16_t)(c->a << 8 | c->f), c->bc, c->de, c->hl, c->sp, c->pc };
    enum { WORDS = sizeof words / sizeof *words };
    uint8_t *bytes = page_buffer(2 * WORDS);
    for (unsigned i = 0; bytes && i < WORDS; i++) {
        bytes[2 * i] = (uint8_t)(words[i] >> 8);
        bytes[2 * i + 1] = (uint8_t)words[i];
    }
    return bytes;
}

/* All of its memory into the buffer. */
EXPORT(page_memory) uint8_t *page_memory(uint32_t which)
{
    uint8_t *bytes = page_buffer(I8080_SPACE);
    for (unsigned i = 0; bytes && i < I8080_SPACE; i++) {
        bytes[i] = i8080_peek(&boards[which].board->cpu, (uint16_t)i);
    }
    return bytes;
}

static uint8_t *taken(record *r)
{
    r->length = 0;
    return r->bytes;
}

/* The length of the paper, of the punched tape and of the notes beside it; then their bytes, which are dropped here. */
EXPORT(page_printed) uint32_t page_printed(uint32_t which)
{
    return boards[which].paper.length;
}
EXPORT(page_take_paper) uint8_t *page_take_paper(uint32_t which)
{
    return taken(&boards[which].paper);
}
EXPORT(page_punched) uint32_t page_punched(uint32_t which)
{
    return boards[which].punch.length;
}
EXPORT(page_take_punch) uint8_t *page_take_punch(uint32_t which)
{
    return taken(&boards[which].punch);
}
EXPORT(page_noted) uint32_t page_noted(uint32_t which)
{
    return boards[which].notes.length;
}
EXPORT(page_take_notes) uint8_t *page_take_notes(uint32_t which)
{
    return taken(&boards[which].notes);
}

/* The RAM into the buffer, and the buffer into the RAM (RAM_KIB). */
EXPORT(page_save) uint8_t *page_save(uint32_t which)
{
    uint8_t *bytes = page_buffer(RAM);
    for (unsigned i = 0; bytes && i < RAM; i++) {
        bytes[i] = i8080_peek(&boards[which].board->cpu, (uint16_t)(board_ram_start(BOARD_6850) + i));
    }
    return bytes;
}
EXPORT(page_restore) void page_restore(uint32_t which, uint32_t length)
{
    for (unsigned i = 0; i < RAM && i < length; i++) {
        i8080_poke(&boards[which].board->cpu, (uint16_t)(board_ram_start(BOARD_6850) + i), buffer.bytes[i]);
    }
}
