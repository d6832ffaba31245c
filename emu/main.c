/* skg80: the SKG board in a terminal
 *
 *      skg80 [options]             the terminal is the teletype; ctrl-] leaves
 *      skg80 [options] part.skg    LOAD, RUN; punch to standard output, paper to standard error
 *      skg80 --com FILE            a CP/M program on a bare 8080
 *
 *      exit    0   done
 *              1   the run ended in ERR, INPUT found no answer, or the machine halted
 *              2   wrong usage, or a file that cannot be read or written
 *              3   --max-cycles were not enough
 *
 * The teletype alone has no punch of its own in a terminal: without --punch FILE what is punched is lost, since the
 * firmware lists every block on the paper anyway.
 *
 * NOT IMPLEMENTED: the tape reader's and punch's own speed; saving the state of the machine.
 */
#include "board.h"
#include "com.h"
#include "image.h"
#include "terminal.h"

#include <errno.h>
#include <getopt.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

enum { EXIT_ERR = 1, EXIT_USAGE = 2, EXIT_CYCLES = 3 };
enum {
    FILE_LIMIT = 16 << 20,          /* bytes; a part or a list of answers is a few thousand */
    PATIENCE = 20000000,            /* cycles that a silent machine may wait for a key nobody will press */
    SLICE_MS = 5,                   /* real time is kept, and the keyboard looked at, so often */
    UNPACED_SLICE = 1000000         /* cycles, when no time is kept */
};

static const char USAGE[] =
    "usage: skg80 [options] [part.skg]\n"
    "  part.skg          LOAD it, RUN it, punch to standard output; without it the terminal is the teletype\n"
    "  --rom FILE        another ROM image, .bin or Intel .hex\n"
    "  --ram KIB         2 to 56 (8)\n"
    "  --input FILE      answers to INPUT, one line each (with a part)\n"
    "  --punch FILE      what is punched\n"
    "  --tty FILE        what is printed\n"
    "  --tape FILE       a tape in the reader (without a part)\n"
    "  --pty             the teletype is a pseudo-terminal, whose name is printed\n"
    "  --mhz F           keep real time at F MHz\n"
    "  --baud N          speed of the teletype's line, 110 to 9600\n"
    "  --board KIND      6850 or 8251 (6850)\n"
    "  --punch-tty       a teletype alone: its own punch and reader\n"
    "  --stats           cycles, instructions, time and memory used, on standard error\n"
    "  --max-cycles N    give up with exit 3\n"
    "  --com FILE        run a CP/M program instead\n"
    "  --help            this\n";

typedef struct {
    const char *part, *rom, *input, *punch, *tty, *tape, *com;
    unsigned ram_kib, baud;
    double mhz;
    uint64_t max_cycles;
    board_kind kind;
    bool pty, stats, punch_tty;
} options;

/* Everything that one run of the program holds open. */
typedef struct {
    options o;
    board *board;
    terminal terminal;
    pacer pacer;
    FILE *paper, *punch;            /* NULL: nowhere */
    uint64_t printed;               /* characters on the paper */
} session;

#ifdef SKG80_BUILT_IN_ROM
extern const uint8_t skg80_rom[BOARD_ROM_SIZE];    /* roms/skg.bin, by rom.S */
#endif

/* The paper, when it is in the middle of a line that the user sees on standard error or in the terminal. */
static const session *open_line;

/* Ends that line, so that a message has one of its own. */
static void end_line(void)
{
    if (open_line && open_line->board->line_length) {
        fputs("\r\n", stderr);
    }
    open_line = NULL;
}

static int complain(int code, const char *format, ...)
{
    va_list arguments;
    end_line();
    va_start(arguments, format);
    fputs("skg80: ", stderr);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
    va_end(arguments);
    return code;
}

/* ---- options ---- */

static bool whole_number(const char *text, uint64_t least, uint64_t most, uint64_t *value)
{
    char *end;
    if (*text < '0' || *text > '9') {
        return false;
    }
    errno = 0;
    *value = strtoull(text, &end, 10);
    return !*end && !errno && *value >= least && *value <= most;
}

/* What is wrong with the options together, or NULL. */
static const char *misfit(const options *o)
{
    if (o->com && (o->part || o->rom || o->input || o->punch || o->tty || o->tape || o->pty || o->punch_tty)) {
        return "--com goes with --stats and --max-cycles alone";
    }
    if (o->part && o->pty) {
        return "--pty needs an operator: no part with it";
    }
    if (o->part && o->tape) {
        return "the part is the tape: no --tape with it";
    }
    if (o->input && !o->part) {
        return "--input needs a part";
    }
    return NULL;
}

/* 0, or the exit code after a message; -1: all is said and done. */
static int read_options(int argc, char **argv, options *o)
{
    enum { ROM = 1, RAM, INPUT, PUNCH, TTY, TAPE, PTY, MHZ, BAUD, BOARD, PUNCH_TTY, STATS, MAX_CYCLES, COM, HELP };
    static const struct option list[] = {
        { "rom", required_argument, NULL, ROM },
        { "ram", required_argument, NULL, RAM },
        { "input", required_argument, NULL, INPUT },
        { "punch", required_argument, NULL, PUNCH },
        { "tty", required_argument, NULL, TTY },
        { "tape", required_argument, NULL, TAPE },
        { "pty", no_argument, NULL, PTY },
        { "mhz", required_argument, NULL, MHZ },
        { "baud", required_argument, NULL, BAUD },
        { "board", required_argument, NULL, BOARD },
        { "punch-tty", no_argument, NULL, PUNCH_TTY },
        { "stats", no_argument, NULL, STATS },
        { "max-cycles", required_argument, NULL, MAX_CYCLES },
        { "com", required_argument, NULL, COM },
        { "help", no_argument, NULL, HELP },
        { NULL, 0, NULL, 0 },
    };
    static const unsigned bauds[] = { 110, 150, 300, 600, 1200, 2400, 4800, 9600 };
    *o = (options){ .ram_kib = BOARD_RAM_KIB, .max_cycles = UINT64_MAX, .kind = BOARD_6850 };
    opterr = 0;
    for (int option; (option = getopt_long(argc, argv, ":", list, NULL)) != -1;) {
        uint64_t number;
        char *end;
        switch (option) {
        case ROM:
            o->rom = optarg;
            break;
        case RAM:
            if (!whole_number(optarg, BOARD_RAM_MIN_KIB, BOARD_RAM_MAX_KIB, &number)) {
                return complain(EXIT_USAGE, "--ram %s: not %d to %d", optarg, BOARD_RAM_MIN_KIB, BOARD_RAM_MAX_KIB);
            }
            o->ram_kib = (unsigned)number;
            break;
        case INPUT:
            o->input = optarg;
            break;
        case PUNCH:
            o->punch = optarg;
            break;
        case TTY:
            o->tty = optarg;
            break;
        case TAPE:
            o->tape = optarg;
            break;
        case PTY:
            o->pty = true;
            break;
        case MHZ:
            o->mhz = strtod(optarg, &end);
            if (end == optarg || *end || !(o->mhz >= 0.001 && o->mhz <= 1000)) {
                return complain(EXIT_USAGE, "--mhz %s: not 0.001 to 1000", optarg);
            }
            break;
        case BAUD:
            if (whole_number(optarg, 1, UINT32_MAX, &number)) {
                for (size_t i = 0; i < sizeof bauds / sizeof *bauds; i++) {
                    o->baud = bauds[i] == number ? bauds[i] : o->baud;
                }
            }
            if (!o->baud || o->baud != number) {
                return complain(EXIT_USAGE, "--baud %s: not 110, 150, 300, 600, 1200, 2400, 4800 or 9600", optarg);
            }
            break;
        case BOARD:
            if (strcmp(optarg, "6850") && strcmp(optarg, "8251")) {
                return complain(EXIT_USAGE, "--board %s: not 6850 or 8251", optarg);
            }
            o->kind = *optarg == '6' ? BOARD_6850 : BOARD_8251;
            break;
        case PUNCH_TTY:
            o->punch_tty = true;
            break;
        case STATS:
            o->stats = true;
            break;
        case MAX_CYCLES:
            if (!whole_number(optarg, 1, UINT64_MAX, &o->max_cycles)) {
                return complain(EXIT_USAGE, "--max-cycles %s: not a number of cycles", optarg);
            }
            break;
        case COM:
            o->com = optarg;
            break;
        case HELP:
            fputs(USAGE, stdout);
            return -1;
        case ':':
            return complain(EXIT_USAGE, "%s needs a value", argv[optind - 1]);
        default:
            return complain(EXIT_USAGE, "%s: no such option; --help lists them", argv[optind - 1]);
        }
    }
    if (argc - optind > 1) {
        return complain(EXIT_USAGE, "%s: one part at a time", argv[optind + 1]);
    }
    o->part = argv[optind];
    const char *wrong = misfit(o);
    return wrong ? complain(EXIT_USAGE, "%s", wrong) : 0;
}

/* ---- what the board prints and punches ---- */

static void print(void *user, uint8_t c)
{
    session *s = user;
    s->printed++;
    if (s->paper) {
        putc(c, s->paper);
    } else {
        terminal_print(&s->terminal, c);
    }
}

static void punch(void *user, uint8_t byte)
{
    session *s = user;
    if (s->punch) {
        putc(byte, s->punch);
    }
}

static void flush(session *s)
{
    FILE *const files[] = { s->paper, s->punch, s->terminal.copy };
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        if (files[i]) {
            fflush(files[i]);
        }
    }
}

static int write_failure(const session *s)
{
    FILE *const files[] = { s->paper, s->punch, s->terminal.copy };
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        if (files[i] && (fflush(files[i]) || ferror(files[i]))) {
            return complain(EXIT_USAGE, "cannot write: %s", strerror(errno));
        }
    }
    return 0;
}

static void print_counts(uint64_t cycles, uint64_t instructions)
{
    fprintf(stderr, "cycles        %llu\ninstructions  %llu\nseconds       %.6f at %d MHz\n",
            (unsigned long long)cycles, (unsigned long long)instructions, (double)cycles / BOARD_HZ,
            BOARD_HZ / 1000000);
}

static void print_stats(const session *s)
{
    const i8080 *c = &s->board->cpu;
    unsigned end = BOARD_RAM_START + s->o.ram_kib * 1024;
    end_line();
    print_counts(c->cycles, c->instructions);
    fprintf(stderr, "RAM           2000 to %04X, written up to %04X\nstack         down to %04X\n", end - 1,
            c->highest_write, c->lowest_sp);
}

/* ---- running ---- */

/* Runs one slice of time, or less when the board asks for something or --max-cycles are used up. */
static board_reason run_slice(session *s)
{
    i8080 *c = &s->board->cpu;
    uint64_t slice = s->pacer.hz > 0 ? (uint64_t)(s->pacer.hz * SLICE_MS / 1000) + 1 : UNPACED_SLICE;
    uint64_t rest = s->o.max_cycles - c->cycles;
    board_reason reason = board_run(s->board, slice < rest ? slice : rest);
    pacer_wait(&s->pacer, c->cycles);
    return reason;
}

static int report_halt(const session *s)
{
    return complain(EXIT_ERR, "the machine halted at %04X", (s->board->cpu.pc - 1) & 0xffff);
}

static int report_cycles(const session *s)
{
    return complain(EXIT_CYCLES, "not done after %llu cycles", (unsigned long long)s->o.max_cycles);
}

/* Lets the machine run until it asks the operator something or all cycles are used up. BOARD_WAIT only when it says
 * nothing for too long. */
static board_reason until_asked(session *s)
{
    i8080 *c = &s->board->cpu;
    uint64_t printed = s->printed, since = c->cycles;
    while (c->cycles < s->o.max_cycles) {
        board_reason reason = run_slice(s);
        if (s->printed != printed || reason == BOARD_CYCLES) {
            printed = s->printed;
            since = c->cycles;
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

/* The operator's work with one part: LOAD, RUN, answers to INPUT. Returns the exit code. */
static int run_part(session *s, const char *answers)
{
    static const char *const commands[] = { "LOAD", "RUN" };
    enum { COMMANDS = sizeof commands / sizeof *commands };
    size_t given = 0;
    unsigned old_errors = 0;
    for (;;) {
        switch (until_asked(s)) {
        case BOARD_PROMPT:
            if (given == 0) {
                old_errors = s->board->error_lines;
            }
            if (s->board->error_lines != old_errors) {
                return EXIT_ERR;
            }
            if (given == COMMANDS) {
                return 0;
            }
            if (!type_line(s, commands[given], strlen(commands[given]))) {
                return complain(EXIT_ERR, "out of memory");
            }
            if (given++ == 0) {
                board_reader(s->board, true);
            }
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
            return complain(EXIT_ERR, "the machine waits for a key at `%s`", s->board->line);
        case BOARD_HALT:
            return report_halt(s);
        default:
            return report_cycles(s);
        }
    }
}

/* The operator at the other end of terminal, pipe or pseudo-terminal. Returns the exit code. */
static int run_terminal(session *s)
{
    i8080 *c = &s->board->cpu;
    terminal *t = &s->terminal;
    uint64_t since_end = 0;
    for (;;) {
        board_reason reason = run_slice(s);
        int wait = 0;
        flush(s);
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
            wait = SLICE_MS;        /* it may be counting the time until something comes */
            break;
        case BOARD_HALT:
            return report_halt(s);
        default:
            break;
        }
        if (c->cycles >= s->o.max_cycles) {
            return report_cycles(s);
        }
        if (t->left) {
            return 0;
        }
        if (reason != BOARD_WAIT || !t->ended) {
            since_end = c->cycles;
        } else if (c->cycles - since_end > PATIENCE) {
            return complain(EXIT_ERR, "the input ended in the middle of `%s`", s->board->line);
        }
        if (!terminal_listen(t, s->board, wait)) {
            return complain(EXIT_ERR, "out of memory");
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
    if (fflush(stdout)) {
        code = complain(EXIT_USAGE, "cannot write: %s", strerror(errno));
    }
    if (end == COM_CYCLES) {
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
    char error[256];
    if (s->o.rom) {
        if (image_rom(s->o.rom, rom, sizeof rom, error, sizeof error)) {
            return complain(EXIT_USAGE, "%s", error);
        }
        board_rom(s->board, rom, sizeof rom);
        return 0;
    }
#ifdef SKG80_BUILT_IN_ROM
    board_rom(s->board, skg80_rom, sizeof skg80_rom);
    return 0;
#else
    return complain(EXIT_USAGE, "built without a ROM: give one with --rom FILE");
#endif
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
    bool fits = board_tape(s->board, bytes, length) && (ended || board_tape(s->board, (const uint8_t *)"\n", 1));
    free(bytes);
    return fits ? 0 : complain(EXIT_ERR, "out of memory");
}

static int open_output(FILE **file, const char *path)
{
    if (path && !(*file = fopen(path, "wb"))) {
        return complain(EXIT_USAGE, "%s: %s", path, strerror(errno));
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
    i8080_watch(&s->board->cpu, s->o.stats, 0, BOARD_ROM_SIZE - 1);
    pacer_start(&s->pacer, mhz * 1e6, 0);
    return set_rom(s);
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
    s->punch = stdout;
    int code = set_tape(s, s->o.part);
    code = code ? code : open_output(&s->paper, s->o.tty);
    code = code ? code : open_output(&s->punch, s->o.punch);
    open_line = s->paper == stderr ? s : NULL;
    code = code ? code : run_part(s, answers ? (const char *)answers : "");
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
    if (!s->o.pty) {
        terminal_open(&s->terminal);
    } else if (terminal_open_pty(&s->terminal)) {
        return complain(EXIT_USAGE, "no pseudo-terminal: %s", strerror(errno));
    } else {
        printf("%s\n", s->terminal.name);
        fflush(stdout);
    }
    s->terminal.copy = copy;
    open_line = s->o.pty ? NULL : s;
    return run_terminal(s);
}

int main(int argc, char **argv)
{
    static session s;
    int code = read_options(argc, argv, &s.o);
    if (code) {
        return code < 0 ? 0 : code;
    }
    if (s.o.com) {
        return run_com(&s.o);
    }
    code = set_board(&s);
    if (!code) {
        code = s.o.part ? with_part(&s) : with_terminal(&s);
        int failure = write_failure(&s);
        code = code ? code : failure;
        if (s.o.stats) {
            print_stats(&s);
        }
    }
    board_free(s.board);
    return code;
}
