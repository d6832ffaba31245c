/* skg80: the SKG board in a terminal
 *
 *      skg80 [options]             the terminal is the teletype; ctrl-] leaves, ctrl-\ resets
 *      skg80 [options] part.skg    LOAD, RUN; punch to standard output, paper to standard error
 *      skg80 --com FILE            a CP/M program on a bare 8080
 *
 *      exit    0   done
 *              1   the run ended in ERR, INPUT found no answer, LOAD no tape, or the machine halted
 *              2   wrong usage, a file that cannot be read or written, or a ROM that does not fit the board
 *              3   --max-cycles were not enough
 *
 * The teletype alone has no punch of its own in a terminal: without --punch FILE what is punched is lost, since the
 * firmware lists every block on the paper anyway.
 *
 * With --punch-pty the punch and the reader are a pseudo-terminal with a machine behind it; standard output has its name
 * (behind that of --pty), and what is punched goes to --punch FILE alone besides. A part is read before the machine
 * is listened to. What the machine says waits until the board asks for it.
 *
 * The drive's options take the operator's part too: with a part he types DRIVE 1 before RUN, and a key at each `D`.
 *
 * NOT IMPLEMENTED: the tape reader's and punch's own speed; characters that a machine loses when nobody asks; saving the state of the machine.
 */
#include "board.h"
#include "com.h"
#include "complain.h"
#include "debug.h"
#include "drawn.h"
#include "image.h"
#include "options.h"
#include "symbols.h"
#include "terminal.h"

#include <ctype.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum {
    FILE_LIMIT = 16 << 20,          /* bytes; a part or a list of answers is a few thousand */
    PATIENCE = 20000000,            /* cycles that a silent machine may wait for a key nobody will press */
    READER_PATIENCE = 6000000,      /* cycles; LOAD gives up after 4,000,000, unless nothing has come yet */
    MACHINE_PATIENCE = 10000,       /* cycles that the board asks for the machine's answer before time stands still */
    LINE_PATIENCE_MS = 5000,        /* so long a machine may leave its line full */
    SLICE_MS = 5,                   /* real time is kept, and the keyboard looked at, so often */
    UNPACED_SLICE = 1000000,        /* cycles, when no time is kept */
    ERROR_LINE = 16,                /* characters of the longest line with ERR: a line number has 4 */
    CTRL_Z = 0x1a                   /* nothing follows on a tape of program lines */
};

/* Everything that one run of the program holds open. */
typedef struct {
    options o;
    board *board;
    debug *debug;                   /* NULL: nobody looks */
    symbols *names;
    terminal terminal;
    terminal line;                  /* the machine's, with --punch-pty */
    bool running;                   /* the part has been loaded and RUN or END typed */
    pacer pacer;
    FILE *paper, *punch, *steps;    /* NULL: nowhere */
    FILE *picture;                  /* of the drive; NULL: none */
    drawn *drawn;                   /* what goes onto it, */
    uint64_t steps_drawn;           /* and how many steps are there already */
    uint64_t printed;               /* characters on the paper */
    char printing[ERROR_LINE + 1];  /* how the present line of it begins */
    size_t line_length;             /* and how long it is */
    bool below_error;               /* the line above is one with ERR */
    const char *rest;               /* what is to be typed when the part is loaded; NULL: nothing */
    int failed;                     /* errno of output that was lost; 0: none */
    bool prompted;                  /* the machine has come to its first prompt */
    uint8_t written[I8080_SPACE];   /* since then (--stats) */
} session;

#ifdef SKG80_BUILT_IN_ROM
extern const uint8_t skg80_rom[BOARD_ROM_SIZE];    /* roms/skg.bin and its symbols, by rom.S */
extern const char skg80_sym[];
#endif

/* ---- what the board prints and punches ---- */

static void put(session *s, uint8_t c, FILE *file)
{
    if (putc(c, file) == EOF) {
        s->failed = errno;
    }
}

/* ERR nn, or ERR nn LINE n, and nothing else (language.md, section 6). */
static bool is_error(const char *line)
{
    static const char words[] = "ERR ", where[] = " LINE ";
    size_t at = sizeof words - 1;
    if (strncmp(line, words, at) || !isdigit((unsigned char)line[at]) || !isdigit((unsigned char)line[at + 1])) {
        return false;
    }
    line += at + 2;
    at = sizeof where - 1;
    return !*line || (!strncmp(line, where, at) && line[at] && !line[at + strspn(line + at, "0123456789")]);
}

/* Keeps the paper's present line, and whether the one above is an error's. */
static void follow(session *s, uint8_t c)
{
    if (c == '\r' || c == '\n') {
        if (s->line_length) {
            s->printing[s->line_length < ERROR_LINE ? s->line_length : ERROR_LINE] = '\0';
            s->below_error = s->line_length <= ERROR_LINE && is_error(s->printing);
        }
        s->line_length = 0;
    } else if (c >= ' ') {
        if (s->line_length < ERROR_LINE) {
            s->printing[s->line_length] = (char)c;
        }
        s->line_length++;
    }
}

static void print(void *user, uint8_t c)
{
    session *s = user;
    s->printed++;
    follow(s, c);
    if (s->paper) {
        put(s, c, s->paper);
    } else {
        terminal_print(&s->terminal, c);
    }
}

static void punch(void *user, uint8_t byte)
{
    session *s = user;
    if (s->punch) {
        put(s, byte, s->punch);
    }
    if (s->o.punch_pty) {
        terminal_print(&s->line, byte);
        s->failed = s->line.deaf ? ETIMEDOUT : s->failed;
    }
}

static void step(void *user, uint8_t value, uint64_t cycles)
{
    session *s = user;
    (void)cycles;
    if (s->steps) {
        put(s, value, s->steps);
    }
    if (s->drawn && !drawn_step(s->drawn, value)) {
        s->failed = ENOMEM;
    }
}

/* Writes the picture, in place of an earlier one. */
static void draw(session *s)
{
    if (!s->picture) {
        return;
    }
    rewind(s->picture);
    /* (an earlier one may be longer) */
    if ((s->steps_drawn && ftruncate(fileno(s->picture), 0)) || !drawn_write(s->drawn, s->picture)) {
        s->failed = errno;
    }
    s->steps_drawn = s->board->drive.steps;
}

/* The board is at its prompt: what has been drawn can be looked at. */
static void draw_meanwhile(session *s)
{
    struct stat file;
    if (s->steps_drawn != s->board->drive.steps && s->picture && !fstat(fileno(s->picture), &file)
        && S_ISREG(file.st_mode)) {
        draw(s);
    }
}

/* Gives all output away; false when some of it is lost. */
static bool flush(session *s)
{
    FILE *const files[] = { s->paper, s->punch, s->steps, s->terminal.copy };
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        if (files[i] && fflush(files[i])) {
            s->failed = errno;
        }
    }
    s->failed = s->failed ? s->failed : s->terminal.failed;
    s->failed = s->failed || !s->debug ? s->failed : debug_failure(s->debug);
    return !s->failed;
}

static int report_failure(const session *s)
{
    if (s->line.deaf) {
        return complain(EXIT_USAGE, "%s: nobody reads what is punched", s->line.name);
    }
    return complain(EXIT_USAGE, "cannot write: %s", strerror(s->failed));
}

static void print_counts(uint64_t cycles, uint64_t instructions)
{
    fprintf(stderr, "cycles        %llu\ninstructions  %llu\nseconds       %.6f at %d MHz\n",
            (unsigned long long)cycles, (unsigned long long)instructions, (double)cycles / BOARD_HZ,
            BOARD_HZ / 1000000);
}

/* The largest piece of RAM that was not written since the first prompt: what program and variables left between them. */
static void print_untouched(const session *s, unsigned end)
{
    unsigned first = end, length = 0;
    for (unsigned at = BOARD_RAM_START, run = 0; at < end; at++) {
        run = s->written[at] ? 0 : run + 1;
        if (run > length) {
            length = run;
            first = at + 1 - run;
        }
    }
    fprintf(stderr, "RAM           2000 to %04X, untouched %04X to %04X: %u bytes\n", end - 1, first,
            first + length - 1, length);
}

static void print_stats(const session *s)
{
    const i8080 *c = &s->board->cpu;
    complain_end_line();
    print_counts(c->cycles, c->instructions);
    print_untouched(s, BOARD_RAM_START + s->o.ram_kib * 1024);
    fprintf(stderr, "stack         down to %04X\n", c->lowest_sp);
    const drive *d = &s->board->drive;
    if (d->gaps) {
        fprintf(stderr, "drive         %llu steps, from one to the next %.1f cycles, at most %llu\n",
                (unsigned long long)d->steps, (double)d->gap_cycles / (double)d->gaps,
                (unsigned long long)d->longest_gap);
    }
}

/* ---- running ---- */

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
        draw_meanwhile(s);
    }
    return reason;
}

/* Has the operator left, by ctrl-] or the debugger's `quit`? */
static bool left(const session *s)
{
    return s->terminal.left || (s->debug && debug_left(s->debug));
}

/* A port was read that nobody serves. */
static int report_nobody(const session *s)
{
    const board *b = s->board;
    if (b->nobody_chip) {
        return complain(EXIT_USAGE, "port %02X is read, and its %s was never readied: is this ROM for --board %s?",
                        b->nobody_port, b->kind == BOARD_6850 ? "6850" : "8251",
                        b->kind == BOARD_6850 ? "8251" : "6850");
    }
    return complain(EXIT_USAGE, "port %02X is read, and nobody serves it%s", b->nobody_port,
                    b->punch_tty ? " with --punch-tty: is this ROM for a punch and reader of their own?" : "");
}

/* What ended the machine's work without an answer from the operator. */
static int report(const session *s, board_reason reason)
{
    const i8080 *c = &s->board->cpu;
    switch (reason) {
    case BOARD_HALT:
        return complain(EXIT_ERR, "the machine halted at %04X", (c->pc - 1) & 0xffff);
    case BOARD_BREAK:
        return complain(EXIT_USAGE, "the machine runs into %04X, where the ROM image has nothing", c->pc);
    case BOARD_NOBODY:
        return report_nobody(s);
    default:
        return complain(EXIT_CYCLES, "not done after %llu cycles", (unsigned long long)s->o.max_cycles);
    }
}

static int report_reader(void)
{
    return complain(EXIT_ERR, "LOAD waits for a tape, and the reader is empty");
}

/* The machine asks for a key, and nobody will press one. */
static int report_wait(const session *s)
{
    const board *b = s->board;
    bool unread = b->tape.first != b->tape.end && !b->punch_tty;
    return complain(EXIT_ERR, "the machine waits for a key at `%s`%s", b->line,
                    unread ? ", its tape unread: is this ROM for --punch-tty?" : "");
}

/* The board waits for the machine's answer: it has asked the reader for a while, and that is empty. */
static bool asks_machine(const session *s)
{
    return s->o.punch_pty && board_reader_silence(s->board) > MACHINE_PATIENCE;
}

/* Lets the machine run until it asks the operator something, has lost output or used up all cycles. BOARD_WAIT only when
 * it says nothing for too long. */
static board_reason until_asked(session *s)
{
    i8080 *c = &s->board->cpu;
    uint64_t printed = s->printed, since = c->cycles;
    while (c->cycles < s->o.max_cycles) {
        board_reason reason = run_slice(s);
        if (!flush(s) || left(s)) {
            return reason;
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

/* The operator's work with one part: LOAD, RUN or END, answers to INPUT; DRIVE 1, a key at each stop. Returns the exit code. */
static int run_part(session *s, const char *answers)
{
    const char *const commands[] = { "LOAD", s->o.drives ? "DRIVE 1" : s->rest, "RUN" };
    const size_t count = s->o.drives ? 3 : s->rest ? 2 : 1;
    size_t given = 0;
    uint64_t at_stop = 0; /* characters on the paper when a stop's key was pressed */
    for (;;) {
        board_reason reason = until_asked(s);
        if (s->failed) {
            return report_failure(s);
        }
        if (left(s)) {
            return 0;
        }
        switch (reason) {
        case BOARD_PROMPT:
            /* (PRINT may write the same words: the prompt does not follow them) */
            if (s->below_error) {
                return EXIT_ERR;
            }
            if (given == count) {
                return 0;
            }
            if (!type_line(s, commands[given], strlen(commands[given]))) {
                return complain(EXIT_ERR, "out of memory");
            }
            if (given++ == 0) {
                board_reader(s->board, true);
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
            /* (at a stop, when something has happened since the last one) */
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

/* LOAD, or DRIVE, has asked an empty reader for so long that the operator should know. Ends with an exit code when he cannot break
 * it off; else 0. */
static int watch_reader(const session *s, bool *told)
{
    bool empty = board_reader_silence(s->board) > READER_PATIENCE && !s->o.punch_pty;
    if (empty && s->terminal.ended) {
        return report_reader();
    }
    if (empty && !*told) {
        remark("the reader is empty (--tape FILE puts a tape in); ctrl-C breaks off");
    }
    *told = empty;
    return 0;
}

/* The operator at the other end of terminal, pipe or pseudo-terminal. Returns the exit code. */
static int run_terminal(session *s)
{
    i8080 *c = &s->board->cpu;
    terminal *t = &s->terminal;
    uint64_t since_end = 0;
    bool told = false;
    for (;;) {
        board_reason reason = run_slice(s);
        int wait = 0;
        if (!flush(s)) {
            return report_failure(s);
        }
        if (left(s)) {
            return 0;
        }
        switch (reason) {
        case BOARD_PROMPT:
            if (t->ended) {
                return 0;
            }
            wait = -1;
            break;
        case BOARD_INPUT:
            if (t->ended) {
                return complain(EXIT_ERR, "INPUT asks, and the input has ended");
            }
            wait = -1;
            break;
        case BOARD_WAIT:
            wait = SLICE_MS; /* it may be counting the time until something comes */
            break;
        case BOARD_CYCLES:
            break;
        default:
            return report(s, reason);
        }
        if (c->cycles >= s->o.max_cycles) {
            return report(s, BOARD_CYCLES);
        }
        int code = watch_reader(s, &told);
        if (code) {
            return code;
        }
        if (reason != BOARD_WAIT || !t->ended) {
            since_end = c->cycles;
        } else if (c->cycles - since_end > PATIENCE) {
            return complain(EXIT_ERR, "the input ended in the middle of `%s`", s->board->line);
        }
        bool idle = told || asks_machine(s);
        if (!terminal_listen(t, s->board, idle && !wait ? SLICE_MS : wait)
            || (asks_machine(s) && !terminal_feed(&s->line, s->board, 0))) {
            return complain(EXIT_ERR, "out of memory");
        }
        if (t->reset) {
            t->reset = false;
            board_reset(s->board);
        }
        if (t->stop) {
            t->stop = false;
            debug_stop(s->debug);
        }
        if (wait) {
            pacer_start(&s->pacer, s->pacer.hz, c->cycles);
        }
    }
}

static int run_com(const options *o)
{
    char error[256];
    size_t length;
    uint8_t *program = image_read(o->com, COM_SIZE, &length, error, sizeof error);
    if (!program) {
        return complain(EXIT_USAGE, "%s", error);
    }
    i8080 *c = malloc(sizeof *c);
    if (!c) {
        free(program);
        return complain(EXIT_ERR, "out of memory");
    }
    int code = 0;
    com_end end = com_run(c, program, length, o->max_cycles, stdout);
    if (fflush(stdout) || ferror(stdout)) {
        code = complain(EXIT_USAGE, "cannot write: %s", strerror(errno));
    } else if (end == COM_CYCLES) {
        code = complain(EXIT_CYCLES, "not done after %llu cycles", (unsigned long long)o->max_cycles);
    } else if (end == COM_HALTED) {
        code = complain(EXIT_ERR, "the program halted at %04X", (c->pc - 1) & 0xffff);
    } else if (end == COM_UNKNOWN) {
        code = complain(EXIT_ERR, "BDOS function %d is not there", c->bc & 0xff);
    }
    if (o->stats) {
        print_counts(c->cycles, c->instructions);
    }
    free(c);
    free(program);
    return code;
}

/* ---- setting up ---- */

static int set_rom(session *s)
{
    uint8_t rom[BOARD_ROM_SIZE];
    bool given[BOARD_ROM_SIZE];
    char error[256];
    if (s->o.rom) {
        if (image_rom(s->o.rom, rom, given, sizeof rom, error, sizeof error)) {
            return complain(EXIT_USAGE, "%s", error);
        }
        board_rom(s->board, rom, sizeof rom);
        for (unsigned i = 0; i < sizeof rom; i++) {
            i8080_break(&s->board->cpu, (uint16_t)i, !given[i]);
        }
        return 0;
    }
#ifdef SKG80_BUILT_IN_ROM
    board_rom(s->board, skg80_rom, sizeof skg80_rom);
    return 0;
#else
    return complain(EXIT_USAGE, "built without a ROM: give one with --rom FILE");
#endif
}

/* What is to be typed when a part is loaded: RUN, or nothing when it has no line numbers and is carried out up to END; END
 * where that is missing, so that an open route gets its last block. */
static const char *rest_of(const uint8_t *bytes, size_t length)
{
    const char *rest = "END";
    for (size_t at = 0; at < length && bytes[at] != CTRL_Z; at++) {
        char begin[3];
        size_t kept = 0;
        for (; at < length && bytes[at] != '\r' && bytes[at] != '\n' && bytes[at] != CTRL_Z; at++) {
            /* (blanks and control characters mean nothing) */
            if (bytes[at] > ' ' && kept++ < sizeof begin) {
                begin[kept - 1] = (char)toupper(bytes[at]);
            }
        }
        if (kept && isdigit((unsigned char)begin[0])) {
            return "RUN";
        }
        if (kept) {
            rest = kept == sizeof begin && !memcmp(begin, "END", kept) ? NULL : "END";
        }
        if (at < length && bytes[at] == CTRL_Z) {
            break;
        }
    }
    return rest;
}

/* A tape for the reader; its last line is ended if the file does not. */
static int set_tape(session *s, const char *path)
{
    char error[256];
    size_t length;
    uint8_t *bytes = image_read(path, FILE_LIMIT, &length, error, sizeof error);
    if (!bytes) {
        return complain(EXIT_USAGE, "%s", error);
    }
    /* (an empty file becomes an empty line: LOAD waits for a first character) */
    bool ended = length && (bytes[length - 1] == '\n' || bytes[length - 1] == '\r');
    s->rest = rest_of(bytes, length);
    bool fits = board_tape(s->board, bytes, length) && (ended || board_tape(s->board, (const uint8_t *)"\n", 1));
    free(bytes);
    return fits ? 0 : complain(EXIT_ERR, "out of memory");
}

static const char NAMELESS[] = ": no .sym file is beside the ROM, and no --sym FILE is given";

/* The names of the ROM: from --sym, from beside --rom, or built in; none of these is no error. */
static int set_names(session *s)
{
    char error[512], path[4096] = "";
    const char *dot = s->o.rom ? strrchr(s->o.rom, '.') : NULL;
    size_t length;
    if (s->o.sym) {
        snprintf(path, sizeof path, "%s", s->o.sym);
    } else if (s->o.rom) {
        snprintf(path, sizeof path, "%.*s.sym", dot ? (int)(dot - s->o.rom) : (int)strlen(s->o.rom), s->o.rom);
        if (access(path, F_OK)) {
            return 0;
        }
    }
#ifdef SKG80_BUILT_IN_ROM
    if (!*path) {
        s->names = symbols_new("skg.sym", skg80_sym, error, sizeof error);
        return s->names ? 0 : complain(EXIT_USAGE, "%s", error);
    }
#endif
    uint8_t *text = image_read(path, FILE_LIMIT, &length, error, sizeof error);
    s->names = text ? symbols_new(path, (const char *)text, error, sizeof error) : NULL;
    free(text);
    return s->names ? 0 : complain(EXIT_USAGE, "%s", error);
}

static int open_output(FILE **file, const char *path)
{
    if (path && !(*file = fopen(path, "wb"))) {
        return complain(EXIT_USAGE, "%s: %s", path, strerror(errno));
    }
    return 0;
}

/* Somebody looks at the machine from inside: --debug, --break, --trace. */
static int set_debug(session *s)
{
    const options *o = &s->o;
    FILE *trace = NULL;
    bool talks = o->debug || o->break_count;
    if (!talks && !o->trace) {
        return o->sym ? complain(EXIT_USAGE, "--sym goes with --debug, --break or --trace") : 0;
    }
    if (talks && !o->part && !o->pty && !isatty(STDIN_FILENO)) {
        return complain(EXIT_USAGE, "--debug and --break need a terminal, a part or --pty");
    }
    int code = set_names(s);
    code = code ? code : open_output(&trace, o->trace);
    if (code) {
        return code;
    }
    s->debug = debug_new(s->board, s->names, trace, o->debug);
    if (!s->debug) {
        return complain(EXIT_ERR, "out of memory");
    }
    for (unsigned i = 0; i < o->break_count; i++) {
        if (!debug_break(s->debug, o->breaks[i])) {
            return complain(EXIT_USAGE, "--break %s: no such place%s", o->breaks[i], s->names ? "" : NAMELESS);
        }
    }
    if (!s->names) {
        remark("the addresses have no names%s", NAMELESS);
    }
    if (talks && (o->part || o->pty)) {
        debug_catch_interrupt();
    }
    return 0;
}

static int set_board(session *s)
{
    s->board = board_new(s->o.kind, s->o.ram_kib);
    if (!s->board) {
        return complain(EXIT_ERR, "out of memory");
    }
    bool operator_waits = !s->o.part;
    double mhz = s->o.mhz > 0 ? s->o.mhz : s->o.baud && operator_waits ? BOARD_HZ / 1e6 : 0;
    s->board->hz = mhz > 0 ? mhz * 1e6 : BOARD_HZ;
    s->board->baud = s->o.baud;
    s->board->punch_tty = s->o.punch_tty;
    s->board->paper = print;
    s->board->punch = punch;
    s->board->user = s;
    s->board->drive.feed_hz = s->o.feed;
    s->board->drive.stop_at = s->o.stop_at;
    s->board->drive.stop_stays = s->o.stop_stays;
    s->board->drive.step = step;
    i8080_watch(&s->board->cpu, s->o.stats, 0, BOARD_ROM_SIZE - 1);
    s->board->cpu.written = s->written;
    pacer_start(&s->pacer, mhz * 1e6, 0);
    return set_rom(s);
}

/* The files that the drive's steps go to. */
static int set_drive(session *s)
{
    int code = open_output(&s->steps, s->o.steps);
    code = code ? code : open_output(&s->picture, s->o.drive);
    if (!code && s->picture && !(s->drawn = drawn_new())) {
        return complain(EXIT_ERR, "out of memory");
    }
    return code;
}

/* What the drive's user should know at the end. */
static void report_drive(const session *s)
{
    const drive *d = &s->board->drive;
    if (!d->steps && s->o.drives) {
        remark("the drive was told no step");
    }
    if (d->hasty) {
        remark("of the drive's steps %llu came together with their direction, or it changed under the pulse",
               (unsigned long long)d->hasty);
    }
}

/* Makes a pseudo-terminal and prints its name. */
static int offer(terminal *t)
{
    if (terminal_open_pty(t)) {
        return complain(EXIT_USAGE, "no pseudo-terminal: %s", strerror(errno));
    }
    if (printf("%s\n", t->name) < 0 || fflush(stdout)) {
        return complain(EXIT_USAGE, "cannot write: %s", strerror(errno));
    }
    return 0;
}

/* The line to the machine, when there is one. */
static int offer_line(session *s)
{
    int code = s->o.punch_pty ? offer(&s->line) : 0;
    s->line.patience = LINE_PATIENCE_MS;
    return code;
}

static int with_part(session *s)
{
    char error[256];
    size_t length;
    uint8_t *answers = NULL;
    if (s->o.input && !(answers = image_read(s->o.input, FILE_LIMIT, &length, error, sizeof error))) {
        return complain(EXIT_USAGE, "%s", error);
    }
    s->paper = stderr;
    s->punch = s->o.punch_pty ? NULL : stdout;
    int code = set_tape(s, s->o.part);
    code = code ? code : open_output(&s->paper, s->o.tty);
    code = code ? code : open_output(&s->punch, s->o.punch);
    complain_beside(s->paper == stderr ? s->board : NULL);
    code = code ? code : offer_line(s);
    code = code ? code : run_part(s, answers ? (const char *)answers : "");
    if (s->o.punch_pty && *s->line.name && !s->line.deaf) {
        terminal_drain(&s->line);
        s->failed = s->line.deaf ? ETIMEDOUT : s->failed;
    }
    free(answers);
    return code;
}

static int with_terminal(session *s)
{
    FILE *copy = NULL;
    int code = s->o.tape ? set_tape(s, s->o.tape) : 0;
    code = code ? code : open_output(&copy, s->o.tty);
    code = code ? code : open_output(&s->punch, s->o.punch);
    if (code) {
        return code;
    }
    code = s->o.pty ? offer(&s->terminal) : 0;
    code = code ? code : offer_line(s);
    if (code) {
        return code;
    }
    if (!s->o.pty) {
        terminal_open(&s->terminal);
    }
    s->terminal.copy = copy;
    terminal_catch_reset();
    if (s->terminal.leaves) {
        s->terminal.stops = s->o.debug || s->o.break_count;
        remark("ctrl-] leaves, ctrl-\\ resets%s", s->terminal.stops ? ", ctrl-^ asks what to do" : "");
    } else if (s->o.pty && isatty(STDERR_FILENO)) {
        remark("ctrl-C ends this; kill -USR1 %ld resets", (long)getpid());
    }
    complain_beside(s->o.pty ? NULL : s->board);
    code = run_terminal(s);
    complain_end_line(); /* the shell's prompt gets a line of its own */
    return code;
}

/* No file that is opened may take the place of a standard stream that is closed: input and output then fail; standard error
 * was silenced. */
static void open_standard_streams(void)
{
    static const int wrong_way[] = { O_WRONLY, O_RDONLY, O_WRONLY };
    for (int fd = STDIN_FILENO; fd <= STDERR_FILENO; fd++) {
        if (fcntl(fd, F_GETFD) < 0 && open("/dev/null", wrong_way[fd]) < 0) {
            _exit(EXIT_USAGE);
        }
    }
}

int main(int argc, char **argv)
{
    static session s;
    open_standard_streams();
    int code = options_read(argc, argv, &s.o);
    if (code) {
        return code < 0 ? 0 : code;
    }
    if (s.o.com) {
        return run_com(&s.o);
    }
    code = set_board(&s);
    code = code ? code : set_debug(&s);
    code = code ? code : set_drive(&s);
    if (!code) {
        code = s.o.part ? with_part(&s) : with_terminal(&s);
        bool known = s.failed && code;
        draw(&s);
        report_drive(&s);
        if (!flush(&s) && !known) {
            code = report_failure(&s);
        }
        if (s.o.stats) {
            print_stats(&s);
        }
    }
    drawn_free(s.drawn);
    debug_free(s.debug);
    symbols_free(s.names);
    board_free(s.board);
    return !code && ferror(stderr) ? EXIT_USAGE : code;
}
