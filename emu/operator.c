#include "operator.h"

#include "complain.h"
#include "output.h"

#include <string.h>

enum {
    PATIENCE = 20000000,            /* cycles that a silent board may wait for a key that nobody can press */
    READER_PATIENCE = 6000000,      /* cycles; LOAD gives up after 4,000,000, unless nothing has come yet */
    MACHINE_PATIENCE = 10000,       /* cycles of polling for the machine's answer before the board's time stops */
    SLICE_MS = 5,                   /* between two looks at clock and keyboard */
    UNPACED_SLICE = 1000000         /* cycles, without real time */
};

/* Runs one slice of time, or less when the board asks for something or --max-cycles are used up. */
static board_reason run_slice(session *s)
{
    i8080 *c = &s->board->cpu;
    uint64_t slice = s->pacer.hz > 0 ? (uint64_t)(s->pacer.hz * SLICE_MS / 1000) + 1 : UNPACED_SLICE;
    uint64_t rest = s->o.max_cycles - c->cycles;
    uint64_t cycles = slice < rest ? slice : rest;
    board_reason reason = s->debug ? debug_run(s->debug, cycles) : board_run(s->board, cycles);
    pacer_wait(&s->pacer, c->cycles);
    if (reason == BOARD_PROMPT && !s->prompted) {
        s->prompted = true;
        memset(s->written, 0, sizeof s->written); /* the size of the RAM was found by writing to it */
    }
    if (reason == BOARD_PROMPT) {
        output_settle(s);
    }
    return reason;
}

/* Has the operator left, by ctrl-] or the debugger's `quit`? */
static bool left(const session *s)
{
    return s->terminal.left || (s->debug && debug_left(s->debug));
}

/* Asks whether the ROM is for one of the boards that have a chip at a port, those with this chip left out; writes nothing
 * where there is none. */
static void ask_for_boards(char *text, size_t size, uint8_t port, const char *chip)
{
    const char *before = ": is it for --board ";
    size_t used = 0;
    text[0] = '\0';
    for (int i = 0; i < BOARD_KINDS; i++) {
        board_kind kind = (board_kind)i;
        if (board_has_port(kind, port) && (!chip || strcmp(board_chip(kind), chip)) && used < size) {
            used += (size_t)snprintf(text + used, size - used, "%s%s", before, board_name(kind));
            before = " or ";
        }
    }
    if (used && used < size) {
        snprintf(text + used, size - used, "?");
    }
}

/* Reports a read of a port without a working chip. */
static int report_nobody(const session *s)
{
    const board *b = s->board;
    const char *chip = board_chip(b->kind);
    char boards[160];
    if (b->nobody_synchronous) {
        return complain(EXIT_USAGE, "the ROM has made the %s at port %02X synchronous, which no teletype is", chip,
                        b->nobody_port);
    }
    ask_for_boards(boards, sizeof boards, b->nobody_port, b->nobody_chip ? chip : NULL);
    if (b->nobody_chip) {
        return complain(EXIT_USAGE, "the ROM reads port %02X before it sets up the %s there%s", b->nobody_port, chip,
                        boards);
    }
    if (b->punch_tty && !board_is_alone(b->kind)) {
        return complain(
            EXIT_USAGE,
            "the ROM reads port %02X, where a board with --punch-tty has no chip: is it for a punch and reader of their own?",
            b->nobody_port);
    }
    return complain(EXIT_USAGE, "the ROM reads port %02X, where this board (%s) has no chip%s", b->nobody_port,
                    board_name(b->kind), boards);
}

/* Reports a halt, a breakpoint, a port without a chip, a silent ROM, or the end of --max-cycles. */
static int report(const session *s, board_reason reason)
{
    const i8080 *c = &s->board->cpu;
    switch (reason) {
    case BOARD_HALT:
        return complain(EXIT_ERR, "the machine halted at %04X", (c->pc - 1) & 0xffff);
    case BOARD_BREAK:
        return complain(EXIT_USAGE,
                        "the processor came to %04X, where the ROM image has no code: is the image complete?", c->pc);
    case BOARD_NOBODY:
        return report_nobody(s);
    default:
        if (c->cycles < s->o.max_cycles) {
            return complain(EXIT_USAGE, "the board printed nothing in %llu cycles: is this ROM for another --board?",
                            (unsigned long long)c->cycles);
        }
        return complain(EXIT_CYCLES, "not done after %llu cycles", (unsigned long long)s->o.max_cycles);
    }
}

static int report_reader(void)
{
    return complain(EXIT_ERR, "LOAD waits for a tape, and the reader is empty");
}

/* Reports that the board waits for a key that nobody can press. */
static int report_wait(const session *s)
{
    const board *b = s->board;
    bool unread = b->tape.first != b->tape.end && !b->punch_tty;
    return complain(EXIT_ERR, "the board waits for a key, and nobody is there to press it; on its paper: `%s`%s",
                    b->line, unread ? "; it has not read its tape: is this ROM for --punch-tty?" : "");
}

/* Tells whether the board waits for the machine's answer: it has polled the empty reader for a while. */
static bool asks_machine(const session *s)
{
    return s->o.punch_pty && board_reader_silence(s->board) > MACHINE_PATIENCE;
}

/* Puts the machine's characters into the reader before a block goes out, so that they are not taken for its answer. */
static bool hear_machine(session *s)
{
    return !s->o.punch_pty || terminal_feed(&s->line, s->board, 0);
}

/* Tells whether the board has printed nothing and moved no motor for much longer than signing on takes. */
static bool is_silent(const session *s)
{
    return s->printed == 0 && s->board->drive.steps == 0 && s->board->cpu.cycles > PATIENCE;
}

/* Lets the machine run until it asks the operator something, has lost output, used up all cycles or never signed on.
 * BOARD_WAIT only when it says nothing for too long. */
static board_reason until_asked(session *s)
{
    i8080 *c = &s->board->cpu;
    uint64_t printed = s->printed, since = c->cycles;
    while (c->cycles < s->o.max_cycles) {
        if (s->running && !hear_machine(s)) {
            return BOARD_CYCLES;
        }
        board_reason reason = run_slice(s);
        if (!output_flush(s) || left(s)) {
            return reason;
        }
        if (is_silent(s)) {
            return BOARD_CYCLES;
        }
        if (s->printed != printed || reason == BOARD_CYCLES) {
            printed = s->printed;
            since = c->cycles;
        }
        if (s->running && asks_machine(s)) {
            if (!terminal_feed(&s->line, s->board, -1)) {
                return BOARD_CYCLES;
            }
            since = c->cycles;
        } else if (board_reader_silence(s->board) > READER_PATIENCE) {
            return BOARD_WAIT;
        }
        if (reason != BOARD_CYCLES && (reason != BOARD_WAIT || c->cycles - since > PATIENCE)) {
            return reason;
        }
    }
    return BOARD_CYCLES;
}

/* Types a line; false without memory. */
static bool type_line(session *s, const char *line, size_t length)
{
    return board_type(s->board, (const uint8_t *)line, length) && board_type(s->board, (const uint8_t *)"\r", 1);
}

int operator_part(session *s, const char *answers)
{
    const char *const commands[] = { "LOAD", s->o.drives ? "DRIVE 1" : s->rest, "RUN" };
    const size_t count = s->o.drives ? 3 : s->rest ? 2 : 1;
    size_t given = 0;
    uint64_t at_stop = 0; /* characters on the paper when a stop's key was pressed */
    for (;;) {
        board_reason reason = until_asked(s);
        if (s->failed) {
            return output_failure(s);
        }
        if (left(s)) {
            return 0;
        }
        switch (reason) {
        case BOARD_PROMPT:
            if (s->refused) {
                return EXIT_ERR;
            }
            if (given == count) {
                return 0;
            }
            if (!type_line(s, commands[given], strlen(commands[given]))) {
                return complain(EXIT_ERR, "out of memory");
            }
            if (given++ == 0 && s->o.reader_cps <= 0) {
                board_reader(s->board, true); /* one that does not wait would come before LOAD: DC1 starts it */
            }
            s->running = given == count;
            break;
        case BOARD_INPUT: {
            if (!*answers) {
                return complain(EXIT_ERR, "INPUT asks, and --input has no line left");
            }
            size_t length = strcspn(answers, "\r\n");
            if (!type_line(s, answers, length)) {
                return complain(EXIT_ERR, "out of memory");
            }
            answers += length;
            answers += *answers == '\r';
            answers += *answers == '\n';
            break;
        }
        case BOARD_WAIT:
            /* (at a stop, when something was printed since the last one) */
            if (s->running && s->o.drives && s->printed != at_stop) {
                at_stop = s->printed;
                if (!type_line(s, "", 0)) {
                    return complain(EXIT_ERR, "out of memory");
                }
                break;
            }
            return board_reader_silence(s->board) ? report_reader() : report_wait(s);
        default:
            return report(s, reason);
        }
    }
}

/* Reports a LOAD or DRIVE that has polled the empty reader for long. Returns an exit code when the operator cannot
 * break it off; else 0. */
static int watch_reader(const session *s, bool *told)
{
    bool empty = board_reader_silence(s->board) > READER_PATIENCE && !s->o.punch_pty;
    if (empty && s->terminal.ended) {
        return report_reader();
    }
    if (empty && !*told && s->terminal.keyboard) {
        remark("the reader is empty (--tape FILE puts a tape in); ctrl-C breaks off");
    }
    *told = empty;
    return 0;
}

/* At the prompt: reports once that the punched tape is lost. */
static void watch_punch(const session *s, bool *told)
{
    if (s->punched_nowhere && !*told) {
        remark("the punched tape is not kept: --punch FILE keeps it");
        *told = true;
    }
}

/* Listens to the terminal for so many ms (-1: until a character comes); false without memory. */
static bool hear_operator(session *s, int wait)
{
    terminal *t = &s->terminal;
    if (!terminal_listen(t, s->board, wait)) {
        return false;
    }
    if (t->reset) {
        t->reset = false;
        board_reset(s->board);
    }
    if (t->stop) {
        t->stop = false;
        debug_stop(s->debug);
    }
    return true;
}

int operator_terminal(session *s)
{
    i8080 *c = &s->board->cpu;
    terminal *t = &s->terminal;
    uint64_t since_end = 0;
    bool told = false, punch_told = false;
    for (;;) {
        if (!hear_machine(s)) {
            return complain(EXIT_ERR, "out of memory");
        }
        board_reason reason = run_slice(s);
        int wait = 0;
        if (!output_flush(s)) {
            return output_failure(s);
        }
        if (left(s)) {
            return 0;
        }
        switch (reason) {
        case BOARD_PROMPT:
            watch_punch(s, &punch_told);
            if (t->ended) {
                return s->refused || t->refused ? EXIT_ERR : 0;
            }
            wait = -1;
            break;
        case BOARD_INPUT:
            if (t->ended) {
                return complain(EXIT_ERR, "INPUT asks, and standard input has ended");
            }
            wait = -1;
            break;
        case BOARD_WAIT:
            wait = SLICE_MS; /* the board may be timing the wait for a character */
            break;
        case BOARD_CYCLES:
            break;
        default:
            return report(s, reason);
        }
        if (c->cycles >= s->o.max_cycles || is_silent(s)) {
            return report(s, BOARD_CYCLES);
        }
        int code = watch_reader(s, &told);
        if (code) {
            return code;
        }
        if (reason != BOARD_WAIT || !t->ended) {
            since_end = c->cycles;
        } else if (c->cycles - since_end > PATIENCE) {
            return complain(EXIT_ERR, "standard input ended in the middle of a line: `%s`", s->board->line);
        }
        bool idle = told || asks_machine(s);
        if (!hear_operator(s, idle && !wait ? SLICE_MS : wait)) {
            return complain(EXIT_ERR, "out of memory");
        }
        if (wait) {
            pacer_start(&s->pacer, s->pacer.hz, c->cycles);
        }
    }
}
