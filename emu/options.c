/* The command line of skg80. See options.h. */
#include "options.h"

#include "complain.h"

#include <errno.h>
#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

static const char USAGE[] =
    "usage: skg80 [options] [part.skg]\n"
    "  part.skg          LOAD it, RUN it, punch to standard output; without it the terminal is the teletype,\n"
    "                    where ctrl-] leaves and ctrl-\\ is the reset button (so is the signal USR1)\n"
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
    "  --punch-pty       punch and reader are a pseudo-terminal, whose name is printed: a machine behind it answers\n"
    "  --drive FILE      draw what the drive was told, as SVG; with a part, DRIVE 1 is typed before RUN, and a key at each D\n"
    "  --steps FILE      write each step of the drive's: one byte, the port's value\n"
    "  --feed HZ         the drive's feed clock (full speed)\n"
    "  --stop-at N       the drive's stop line rises at step N, until the next key; N,stay: for ever\n"
    "  --stats           cycles, instructions, time and memory used, on standard error\n"
    "  --max-cycles N    give up with exit 3\n"
    "  --debug           stop before the first instruction and ask what to do (help); ctrl-^ asks again\n"
    "  --break PLACE     ask when the machine comes to a label or hexadecimal address (may be repeated)\n"
    "  --trace FILE      write every instruction, and every operation of the calculator, to a file\n"
    "  --sym FILE        the ROM's names (built in, or beside FILE.bin: FILE.sym)\n"
    "  --com FILE        run a CP/M program instead\n"
    "  --help            this\n"
    "exit: 0 done, 1 the run ended in ERR, 2 wrong usage or a file that cannot be read or written, 3 --max-cycles\n";

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
    if (o->com
        && (o->part || o->rom || o->input || o->punch || o->tty || o->tape || o->pty || o->punch_tty || o->punch_pty
            || o->debug || o->break_count || o->trace || o->sym || o->drives)) {
        return "--com goes with --stats and --max-cycles alone";
    }
    if (o->part && o->pty) {
        return "--pty needs an operator: no part with it";
    }
    if (o->part && o->tape) {
        return "the part is the tape: no --tape with it";
    }
    if (o->punch_tty && o->punch_pty) {
        return "--punch-pty is a port of its own: a teletype alone has none";
    }
    if (o->input && !o->part) {
        return "--input needs a part";
    }
    const char *const files[] = { o->part,  o->rom, o->input, o->tape,  o->sym,
                                  o->punch, o->tty, o->trace, o->drive, o->steps };
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        if (files[i] && !strcmp(files[i], "-")) {
            return "-: expected a file's name; /dev/stdin and /dev/stdout are the standard input and output";
        }
    }
    return NULL;
}

static bool same_file(const char *a, const char *b)
{
    struct stat one, other;
    return a && b && !stat(a, &one) && !stat(b, &other) && S_ISREG(one.st_mode) && one.st_dev == other.st_dev
           && one.st_ino == other.st_ino;
}

/* Two files that are to be written, and may not be there yet. */
static bool will_be_one(const char *a, const char *b)
{
    struct stat file;
    return same_file(a, b) || (a && b && !strcmp(a, b) && stat(a, &file));
}

/* A file that would be written over what is read, or over what else is written; NULL: none. */
static const char *overwritten(const options *o)
{
    const char *const read[] = { o->part, o->rom, o->input, o->tape, o->sym };
    const char *const written[] = { o->punch, o->tty, o->trace, o->drive, o->steps };
    enum { WRITTEN = sizeof written / sizeof *written };
    for (size_t w = 0; w < WRITTEN; w++) {
        for (size_t r = 0; r < sizeof read / sizeof *read; r++) {
            if (same_file(written[w], read[r])) {
                return written[w];
            }
        }
    }
    for (size_t w = 0; w < WRITTEN; w++) {
        for (size_t v = 0; v < w; v++) {
            if (will_be_one(written[w], written[v])) {
                return written[w];
            }
        }
    }
    return NULL;
}

/* A number with a point or without one, of a value in range. */
static bool decimal_number(const char *text, double least, double most, double *value)
{
    char *end;
    *value = strtod(text, &end);
    return end != text && !*end && *value >= least && *value <= most;
}

/* Does a file's name promise no other kind of picture? */
static bool may_be_svg(const char *path)
{
    const char *slash = strrchr(path, '/'), *dot = strrchr(slash ? slash : path, '.');
    return !dot || !strcasecmp(dot, ".svg");
}

/* The step at which the drive is to stop: N, or N,stay. */
static bool read_stop(const char *text, options *o)
{
    static const char stay[] = ",stay";
    char digits[24];
    size_t length = strcspn(text, ",");
    if (length >= sizeof digits || (text[length] && strcmp(text + length, stay))) {
        return false;
    }
    snprintf(digits, sizeof digits, "%.*s", (int)length, text);
    o->stop_stays = text[length];
    return whole_number(digits, 1, UINT64_MAX, &o->stop_at);
}

/* What getopt_long did not like: an option that is not there, or a value where none belongs. */
static int refuse(char **argv)
{
    const char *word = argv[optind - 1];
    if (optopt && !strncmp(word, "--", 2)) {
        return complain(EXIT_USAGE, "%s: this option takes no value", word);
    }
    if (optopt) {
        return complain(EXIT_USAGE, "-%c: no such option; --help lists them", optopt);
    }
    return complain(EXIT_USAGE, "%s: no such option; --help lists them", word);
}

int options_read(int argc, char **argv, options *o)
{
    // clang-format off
    enum { ROM = 1, RAM, INPUT, PUNCH, TTY, TAPE, PTY, MHZ, BAUD, BOARD, PUNCH_TTY, PUNCH_PTY, DRIVE, STEPS, FEED, STOP_AT, STATS,
           MAX_CYCLES, COM, DEBUG, BREAK, TRACE, SYM, HELP };
    // clang-format on
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
        { "punch-pty", no_argument, NULL, PUNCH_PTY },
        { "drive", required_argument, NULL, DRIVE },
        { "steps", required_argument, NULL, STEPS },
        { "feed", required_argument, NULL, FEED },
        { "stop-at", required_argument, NULL, STOP_AT },
        { "stats", no_argument, NULL, STATS },
        { "max-cycles", required_argument, NULL, MAX_CYCLES },
        { "com", required_argument, NULL, COM },
        { "debug", no_argument, NULL, DEBUG },
        { "break", required_argument, NULL, BREAK },
        { "trace", required_argument, NULL, TRACE },
        { "sym", required_argument, NULL, SYM },
        { "help", no_argument, NULL, HELP },
        { NULL, 0, NULL, 0 },
    };
    static const unsigned bauds[] = { 110, 150, 300, 600, 1200, 2400, 4800, 9600 };
    *o = (options){ .ram_kib = BOARD_RAM_KIB, .max_cycles = UINT64_MAX, .kind = BOARD_6850 };
    opterr = 0;
    for (int option; (option = getopt_long(argc, argv, ":", list, NULL)) != -1;) {
        uint64_t number;
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
            if (!decimal_number(optarg, 0.001, 1000, &o->mhz)) {
                return complain(EXIT_USAGE, "--mhz %s: not 0.001 to 1000", optarg);
            }
            break;
        case BAUD:
            o->baud = 0;
            if (whole_number(optarg, 1, UINT32_MAX, &number)) {
                for (size_t i = 0; i < sizeof bauds / sizeof *bauds; i++) {
                    o->baud = bauds[i] == number ? bauds[i] : o->baud;
                }
            }
            if (!o->baud) {
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
        case PUNCH_PTY:
            o->punch_pty = true;
            break;
        case DRIVE:
            if (!may_be_svg(optarg)) {
                return complain(EXIT_USAGE, "--drive %s: what it draws is SVG: expected a name that ends in .svg",
                                optarg);
            }
            o->drive = optarg;
            break;
        case STEPS:
            o->steps = optarg;
            break;
        case FEED:
            if (!decimal_number(optarg, 0.01, 1e6, &o->feed)) {
                return complain(EXIT_USAGE, "--feed %s: not 0.01 to 1000000", optarg);
            }
            break;
        case STOP_AT:
            if (!read_stop(optarg, o)) {
                return complain(EXIT_USAGE, "--stop-at %s: not a step's number, 1 or more, or that and `,stay`",
                                optarg);
            }
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
        case DEBUG:
            o->debug = true;
            break;
        case BREAK:
            if (o->break_count == OPTIONS_BREAKS) {
                return complain(EXIT_USAGE, "--break %s: more than %d", optarg, OPTIONS_BREAKS);
            }
            o->breaks[o->break_count++] = optarg;
            break;
        case TRACE:
            o->trace = optarg;
            break;
        case SYM:
            o->sym = optarg;
            break;
        case HELP:
            fputs(USAGE, stdout);
            return fflush(stdout) ? complain(EXIT_USAGE, "cannot write: %s", strerror(errno)) : -1;
        case ':':
            return complain(EXIT_USAGE, "%s needs a value", argv[optind - 1]);
        default:
            return refuse(argv);
        }
    }
    if (argc - optind > 1) {
        return complain(EXIT_USAGE, "%s: one part at a time", argv[optind + 1]);
    }
    o->part = argv[optind];
    o->drives = o->drive || o->steps || o->feed > 0 || o->stop_at;
    const char *wrong = misfit(o), *lost = wrong ? NULL : overwritten(o);
    if (lost) {
        return complain(EXIT_USAGE, "%s: one file for two purposes", lost);
    }
    return wrong ? complain(EXIT_USAGE, "%s", wrong) : 0;
}
