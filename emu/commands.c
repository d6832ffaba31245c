/* The debugger's commands and their answers. See debug.h. */
#include "debug_state.h"

#include "complain.h"
#include "listing.h"
#include "terminal.h"
#include "trace.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

enum { LINE = 256, STACK_WORDS = 12, CODE_LINES = 12, MEMORY_ROW = 16 };
enum { OPCODE_CALL = 0xcd, OPCODE_CALLS = 0xc4, OPCODE_RST = 0xc7 };
enum { RST_CALC = 0xef };

/* ---- display ---- */

static void show_place(const debug *d)
{
    const i8080 *c = &d->board->cpu;
    if (trace_at_operation(c, d->calculator)) {
        trace_operation(c, d->calculator, stderr);
    } else {
        trace_instruction(c, d->names, stderr);
    }
}

static void show_memory(const debug *d, uint16_t address, unsigned count)
{
    for (unsigned i = 0; i < count; i += MEMORY_ROW) {
        char text[MEMORY_ROW + 1] = "";
        fprintf(stderr, "%04X ", (address + i) & 0xffff);
        for (unsigned k = 0; k < MEMORY_ROW && i + k < count; k++) {
            uint8_t byte = i8080_peek(&d->board->cpu, (uint16_t)(address + i + k));
            fprintf(stderr, " %02X", byte);
            text[k] = byte >= ' ' && byte < 0x7f ? (char)byte : '.';
        }
        fprintf(stderr, "  %s\n", text);
    }
}

static void show_stack(const debug *d)
{
    const i8080 *c = &d->board->cpu;
    uint16_t top = 0;
    unsigned end = symbols_value(d->names, "STKTOP", &top) && top > c->sp ? top : c->sp + 2 * STACK_WORDS;
    for (unsigned at = c->sp; at + 1 < end && at < c->sp + 2u * STACK_WORDS; at += 2) {
        uint16_t word = (uint16_t)(i8080_peek(c, (uint16_t)at) | i8080_peek(c, (uint16_t)(at + 1)) << 8);
        char place[SYMBOLS_PLACE];
        fprintf(stderr, "%04X %04X %s\n", at, word, word < BOARD_ROM_SIZE ? symbols_place(d->names, word, place) : "");
    }
}

static void show_breaks(const debug *d)
{
    char place[SYMBOLS_PLACE];
    for (unsigned i = 0; i < d->breaks.count; i++) {
        fprintf(stderr, "%04X %s\n", d->breaks.at[i], symbols_place(d->names, d->breaks.at[i], place));
    }
}

/* ---- commands ---- */

/* A command's words behind its name. */
typedef struct {
    const char *first, *second; /* NULL: none */
} words;

typedef void command_fn(debug *d, const words *w);

static void complain_of(const char *what, const char *word)
{
    fprintf(stderr, "%s: %s\n", word, what);
}

/* An address out of a word, or `otherwise` when there is none; false after a message. */
static bool get_address(const debug *d, const char *word, uint16_t otherwise, uint16_t *address)
{
    *address = otherwise;
    if (word && !symbols_address(d->names, word, address)) {
        complain_of("no such place (a label, or a hexadecimal address)", word);
        return false;
    }
    return true;
}

/* A decimal number, or `otherwise` when there is none; false after a message. */
static bool get_number(const char *word, uint64_t otherwise, uint64_t *number)
{
    char *end;
    *number = otherwise;
    if (!word) {
        return true;
    }
    *number = strtoull(word, &end, 10);
    if (*word < '0' || *word > '9' || *end || !*number || *number > 1000000000000) {
        complain_of("expected a number, 1 or more", word);
        return false;
    }
    return true;
}

static void start(debug *d, mode how)
{
    d->mode = how;
}

static void do_step(debug *d, const words *w)
{
    if (get_number(w->first, 1, &d->count)) {
        start(d, STEPS);
    }
}

static bool knows_calculator(const debug *d)
{
    if (!d->calculator) {
        fputs("without symbols (--sym FILE) the calculator is not shown\n", stderr);
    }
    return d->calculator;
}

static void do_operation(debug *d, const words *w)
{
    if (knows_calculator(d) && get_number(w->first, 1, &d->count)) {
        start(d, OPERATES);
    }
}

static void do_up(debug *d, const words *w)
{
    (void)w;
    d->stack = d->board->cpu.sp;
    start(d, RETURNS);
}

static void do_next(debug *d, const words *w)
{
    const i8080 *c = &d->board->cpu;
    uint8_t opcode = i8080_peek(c, c->pc);
    bool calls = opcode == OPCODE_CALL || (opcode & OPCODE_RST) == OPCODE_CALLS || (opcode & OPCODE_RST) == OPCODE_RST;
    (void)w;
    d->count = 1;
    d->stack = (uint16_t)(c->sp - 1);
    start(d, calls ? RETURNS : STEPS);
}

static void do_continue(debug *d, const words *w)
{
    (void)w;
    start(d, RUNS);
}

static void do_break(debug *d, const words *w)
{
    uint16_t address;
    if (!w->first) {
        show_breaks(d);
    } else if (get_address(d, w->first, 0, &address) && !breaks_set(&d->breaks, address)) {
        complain_of("too many breakpoints", w->first);
    }
}

static void do_delete(debug *d, const words *w)
{
    uint16_t address;
    if (!w->first) {
        d->breaks.count = 0;
    } else if (get_address(d, w->first, 0, &address) && !breaks_delete(&d->breaks, address)) {
        complain_of("no breakpoint there", w->first);
    }
}

static void do_registers(debug *d, const words *w)
{
    (void)w;
    trace_instruction(&d->board->cpu, d->names, stderr);
}

static unsigned at_most(uint64_t count)
{
    return count > LISTING_LONGEST ? LISTING_LONGEST : (unsigned)count;
}

static void do_list(debug *d, const words *w)
{
    uint16_t address;
    uint64_t count;
    if (get_address(d, w->first, d->board->cpu.pc, &address) && get_number(w->second, CODE_LINES, &count)) {
        listing_print(d->names, d->calculator, &d->board->cpu, address, at_most(count), stderr);
    }
}

static void do_code(debug *d, const words *w)
{
    const i8080 *c = &d->board->cpu;
    uint16_t address;
    uint64_t count;
    if (!knows_calculator(d)) {
        return;
    }
    if (!w->first && !trace_at_operation(c, d->calculator)) {
        fputs("the calculator is not at an operation: code PLACE\n", stderr);
    } else if (get_address(d, w->first, c->bc, &address) && get_number(w->second, LISTING_LONGEST, &count)) {
        /* (a routine that begins with DB CALC: its byte-code stands behind the restart) */
        address += !*d->calculator->code[RST_CALC] && i8080_peek(c, address) == RST_CALC;
        calculator_print_code(d->calculator, c, address, at_most(count), stderr);
    }
}

static void do_memory(debug *d, const words *w)
{
    uint16_t address;
    uint64_t count;
    if (get_address(d, w->first, d->board->cpu.hl, &address) && get_number(w->second, 4 * MEMORY_ROW, &count)) {
        show_memory(d, address, count > I8080_SPACE ? I8080_SPACE : (unsigned)count);
    }
}

static void do_stack(debug *d, const words *w)
{
    (void)w;
    show_stack(d);
}

static void do_floats(debug *d, const words *w)
{
    (void)w;
    if (knows_calculator(d)) {
        fputs("|", stderr);
        calculator_print_stack(d->calculator, &d->board->cpu, stderr);
        fputc('\n', stderr);
    }
}

static void do_m(debug *d, const words *w)
{
    const char *const names[] = { w->first, w->second };
    for (unsigned i = 0; knows_calculator(d) && i < 2 && (!i || names[i]); i++) {
        if (!calculator_print_registers(d->calculator, &d->board->cpu, names[i], stderr)) {
            complain_of("no such register", names[i]);
        }
    }
}

static void do_trace(debug *d, const words *w)
{
    if (d->trace) {
        d->trace_failed = fclose(d->trace) ? errno : d->trace_failed;
        d->trace = NULL;
    }
    if (w->first && !(d->trace = fopen(w->first, "w"))) {
        complain_of(strerror(errno), w->first);
    }
}

static void do_quit(debug *d, const words *w)
{
    (void)w;
    d->left = true;
    start(d, RUNS);
}

static command_fn do_help;

static const struct {
    const char *name, *takes, *what;
    command_fn *does;
} commands[] = {
    { "step", "[N]", "does N instructions (1)", do_step },
    { "next", "", "does an instruction, a call with all that it calls", do_next },
    { "operation", "[N]", "runs to the calculator's N-th operation from here (1)", do_operation },
    { "up", "", "runs until the processor's stack is shorter: the routine has returned", do_up },
    { "continue", "", "runs to a breakpoint", do_continue },
    { "break", "[PLACE]", "sets a breakpoint, in machine code or byte-code, or lists all", do_break },
    { "delete", "[PLACE]", "takes a breakpoint away, or all", do_delete },
    { "registers", "", "the processor's registers and what comes next", do_registers },
    { "list", "[PLACE [N]]", "N instructions (12) from there, or from here", do_list },
    { "code", "[PLACE [N]]", "byte-code from there, or from where the calculator is", do_code },
    { "floats", "", "the calculator's stack, the top last", do_floats },
    { "m", "[NAME [NAME]]", "registers of the calculator (M35, HX), or all that are not 0", do_m },
    { "memory", "[PLACE [N]]", "N bytes (64) from there, or from HL", do_memory },
    { "stack", "", "the processor's stack", do_stack },
    { "trace", "[FILE]", "writes all instructions to a file from now on, or ends that", do_trace },
    { "help", "", "this", do_help },
    { "quit", "", "leaves skg80", do_quit },
};
enum { COMMANDS = sizeof commands / sizeof *commands };

static void do_help(debug *d, const words *w)
{
    (void)d;
    (void)w;
    for (unsigned i = 0; i < COMMANDS; i++) {
        fprintf(stderr, "%-10s %-14s %s\n", commands[i].name, commands[i].takes, commands[i].what);
    }
    fputs(
        "A command may be cut short: the first one that begins so is meant. An empty line repeats the last. PLACE is a\n"
        "label or cell of the sources, one with a distance (CALC1+2), or a hexadecimal address.\n",
        stderr);
}

/* Carries out one line. */
static void obey(debug *d, char *line)
{
    const char *name = strtok(line, " \t\r\n");
    words w = { .first = name ? strtok(NULL, " \t\r\n") : NULL };
    w.second = w.first ? strtok(NULL, " \t\r\n") : NULL;
    for (unsigned i = 0; name && i < COMMANDS; i++) {
        if (!strncasecmp(commands[i].name, name, strlen(name))) {
            commands[i].does(d, &w);
            return;
        }
    }
    if (name) {
        complain_of("no such command; help lists them", name);
    }
}

/* A line of standard input, read without stdio's buffer: the characters behind it belong to the board. False at its
 * end. */
static bool read_line(char line[LINE])
{
    size_t length = 0;
    char c;
    ssize_t got;
    while ((got = read(STDIN_FILENO, &c, 1)) == 1 || (got < 0 && errno == EINTR)) {
        if (got != 1) {
            continue;
        }
        if (c == '\n') {
            line[length] = '\0';
            return true;
        }
        if (length < LINE - 1) {
            line[length++] = c;
        }
    }
    line[length] = '\0';
    return length;
}

void debug_talk(debug *d)
{
    static char last[LINE];
    char line[LINE];
    bool raw = terminal_pause(), typed = isatty(STDIN_FILENO);
    complain_end_line();
    show_place(d);
    while (d->mode == STOPPED) {
        fputs("debug> ", stderr);
        if (!read_line(line)) {
            fputc('\n', stderr);
            do_quit(d, NULL);
            break;
        }
        if (!typed) {
            fprintf(stderr, "%s\n", line);
        }
        if (line[strspn(line, " \t\r")]) {
            memcpy(last, line, sizeof last);
        } else {
            memcpy(line, last, sizeof line);
        }
        obey(d, line);
    }
    if (raw) {
        terminal_resume();
    }
}
