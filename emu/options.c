/* The command line of skg80. See options.h. */
#include "options.h"

#include "complain.h"
#include "image.h"
#include "outfile.h"

#include <errno.h>
#include <getopt.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#ifdef _WIN32
#include <windows.h>
#endif

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
    "  --board KIND      6850, 8251, rc2014, rc2014-sio, minimax8085 or rcbus8085 (6850)\n"
    "  --ports TTY,PUNCH other ports: the lower one of each pair, hexadecimal (10,12)\n"
    "  --punch-tty       a teletype alone: its own punch and reader\n"
    "  --punch-pty       punch and reader are a pseudo-terminal, whose name is printed: a machine behind it answers\n"
    "  --reader-cps N    the reader does not wait: N characters a second, some are lost\n"
    "  --keyboard-cps N  what is typed or piped does not wait either\n"
    "  --cts N           both stop N characters after /RTS has risen (they do not look at it)\n"
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
    "  --version         the version, and the built-in ROM's CRC-32\n"
    "  --help            this\n"
    "exit: 0 done, 1 ERR with a part or a pipe, 2 wrong usage or a file that cannot be read or written, 3 --max-cycles\n";

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

/* The error in the combination of options, or NULL. */
static const char *misfit(const options *o)
{
    if (o->com
        && (o->part || o->rom || o->input || o->punch || o->tty || o->tape || o->pty || o->punch_tty || o->punch_pty
            || o->debug || o->break_count || o->trace || o->sym || o->drives)) {
        return "--com: only --stats and --max-cycles go with it";
    }
    if (o->part && o->pty) {
        return "--pty: not with a part; somebody types at a pseudo-terminal";
    }
    if (o->part && o->tape) {
        return "--tape: not with a part, which is the tape in the reader";
    }
    if (o->punch_tty && o->punch_pty) {
        return "--punch-pty: not with a teletype alone (--punch-tty, --board rc2014), which has no port for a punch";
    }
    if (o->lag >= 0 && !(o->reader_cps > 0 || o->keyboard_cps > 0)) {
        return "--cts needs --reader-cps or --keyboard-cps: without them every sender waits";
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

#ifdef _WIN32
/* Identifies a file by volume and number; false for anything that is no file on a disk. (Windows' stat gives no
 * number.) */
static bool identify(const char *path, BY_HANDLE_FILE_INFORMATION *file)
{
    HANDLE handle =
        CreateFileA(path, 0, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, NULL, OPEN_EXISTING, 0, NULL);
    bool found = handle != INVALID_HANDLE_VALUE && GetFileType(handle) == FILE_TYPE_DISK
                 && GetFileInformationByHandle(handle, file);
    if (handle != INVALID_HANDLE_VALUE) {
        CloseHandle(handle);
    }
    return found;
}

static bool same_file(const char *a, const char *b)
{
    BY_HANDLE_FILE_INFORMATION one, other;
    return a && b && identify(a, &one) && identify(b, &other) && one.dwVolumeSerialNumber == other.dwVolumeSerialNumber
           && one.nFileIndexHigh == other.nFileIndexHigh && one.nFileIndexLow == other.nFileIndexLow;
}
#else
static bool same_file(const char *a, const char *b)
{
    struct stat one, other;
    return a && b && !stat(a, &one) && !stat(b, &other) && S_ISREG(one.st_mode) && one.st_dev == other.st_dev
           && one.st_ino == other.st_ino;
}
#endif

/* Tells whether two output files, which need not exist yet, are the same. */
static bool will_be_one(const char *a, const char *b)
{
    struct stat file;
    return same_file(a, b) || (a && b && !strcmp(a, b) && stat(a, &file));
}

/* Is a file the one that another is written to at first? */
static bool is_part(const char *part, const char *written)
{
    char name[4096];
    return part && written && snprintf(name, sizeof name, "%s" OUTFILE_PART, written) < (int)sizeof name
           && will_be_one(part, name);
}

/* The output file that is also an input, or another output; NULL: none. */
static const char *overwritten(const options *o)
{
    const char *const read[] = { o->part, o->rom, o->input, o->tape, o->sym };
    const char *const written[] = { o->punch, o->tty, o->trace, o->drive, o->steps };
    enum { WRITTEN = sizeof written / sizeof *written };
    for (size_t w = 0; w < WRITTEN; w++) {
        for (size_t r = 0; r < sizeof read / sizeof *read; r++) {
            if (same_file(written[w], read[r]) || is_part(read[r], written[w])) {
                return written[w];
            }
        }
    }
    for (size_t w = 0; w < WRITTEN; w++) {
        for (size_t v = 0; v < WRITTEN; v++) {
            if ((v < w && will_be_one(written[w], written[v])) || is_part(written[v], written[w])) {
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

static bool read_ram(const char *text, options *o)
{
    uint64_t kib = 0;
    bool fits = whole_number(text, BOARD_RAM_MIN_KIB, BOARD_RAM_MAX_KIB, &kib);
    o->ram_kib = (unsigned)kib;
    return fits;
}

static bool read_mhz(const char *text, options *o)
{
    return decimal_number(text, 0.001, 1000, &o->mhz);
}

static bool read_baud(const char *text, options *o)
{
    static const unsigned bauds[] = { 110, 150, 300, 600, 1200, 2400, 4800, 9600 };
    uint64_t number;
    if (!whole_number(text, 1, UINT32_MAX, &number)) {
        return false;
    }
    for (size_t i = 0; i < sizeof bauds / sizeof *bauds; i++) {
        if (bauds[i] == number) {
            o->baud = bauds[i];
            return true;
        }
    }
    return false;
}

static bool read_board(const char *text, options *o)
{
    for (int i = 0; i < BOARD_KINDS; i++) {
        if (!strcmp(text, board_name((board_kind)i))) {
            o->kind = (board_kind)i;
            o->punch_tty |= board_is_alone(o->kind);
            return true;
        }
    }
    return false;
}

/* The lower ports of two pairs, with a comma between them. */
static bool read_ports(const char *text, options *o)
{
    unsigned tty, aux;
    int length = 0;
    if (sscanf(text, "%2x,%2x%n", &tty, &aux, &length) != 2 || text[length] || (tty | aux) & 1 || tty == aux
        || tty == DRIVE_PORT || aux == DRIVE_PORT) {
        return false;
    }
    o->tty_ports = (uint8_t)tty;
    o->aux_ports = (uint8_t)aux;
    return true;
}

/* Takes the drawing's name; false if its ending belongs to another kind of picture. */
static bool read_drive(const char *text, options *o)
{
    const char *slash = strrchr(text, '/'), *dot = strrchr(slash ? slash : text, '.');
    o->drive = text;
    return !dot || !strcasecmp(dot, ".svg");
}

static bool read_reader_cps(const char *text, options *o)
{
    return decimal_number(text, 0.1, 100000, &o->reader_cps);
}

static bool read_keyboard_cps(const char *text, options *o)
{
    return decimal_number(text, 0.1, 100000, &o->keyboard_cps);
}

static bool read_cts(const char *text, options *o)
{
    uint64_t lag = 0;
    bool fits = whole_number(text, 0, 1000, &lag);
    o->lag = (int)lag;
    return fits;
}

static bool read_feed(const char *text, options *o)
{
    return decimal_number(text, 0.01, 1e6, &o->feed);
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

static bool read_max_cycles(const char *text, options *o)
{
    return whole_number(text, 1, UINT64_MAX, &o->max_cycles);
}

static bool read_break(const char *text, options *o)
{
    if (o->break_count == OPTIONS_BREAKS) {
        return false;
    }
    o->breaks[o->break_count++] = text;
    return true;
}

/* An option sets a flag or a text of `options`, or its value is read and may be wrong. */
typedef enum { FLAG, TEXT, VALUE, HELP, VERSION } option_kind;

typedef struct {
    const char *name;
    option_kind kind;
    size_t at;                                      /* FLAG, TEXT: the member that it sets */
    bool (*read)(const char *text, options *o);     /* VALUE */
    const char *wrong;                              /* VALUE: the message when `read` refuses it */
} option_rule;

// clang-format off
#define SETS(member) offsetof(options, member), NULL, NULL
static const option_rule RULES[] = {
    { "rom",        TEXT,  SETS(rom) },
    { "ram",        VALUE, 0, read_ram, "not 2 to 56" },
    { "input",      TEXT,  SETS(input) },
    { "punch",      TEXT,  SETS(punch) },
    { "tty",        TEXT,  SETS(tty) },
    { "tape",       TEXT,  SETS(tape) },
    { "pty",        FLAG,  SETS(pty) },
    { "mhz",        VALUE, 0, read_mhz, "not 0.001 to 1000" },
    { "baud",       VALUE, 0, read_baud, "not 110, 150, 300, 600, 1200, 2400, 4800 or 9600" },
    { "board",      VALUE, 0, read_board, "not 6850, 8251, rc2014, rc2014-sio, minimax8085 or rcbus8085" },
    { "ports",      VALUE, 0, read_ports, "expected two even hexadecimal ports, not the drive's 14, such as 20,22" },
    { "punch-tty",  FLAG,  SETS(punch_tty) },
    { "punch-pty",  FLAG,  SETS(punch_pty) },
    { "reader-cps", VALUE, 0, read_reader_cps, "not 0.1 to 100000" },
    { "keyboard-cps", VALUE, 0, read_keyboard_cps, "not 0.1 to 100000" },
    { "cts",        VALUE, 0, read_cts, "not 0 to 1000" },
    { "drive",      VALUE, 0, read_drive, "what it draws is SVG: expected a name that ends in .svg" },
    { "steps",      TEXT,  SETS(steps) },
    { "feed",       VALUE, 0, read_feed, "not 0.01 to 1000000" },
    { "stop-at",    VALUE, 0, read_stop, "expected a step's number, 1 or more, or that and `,stay`" },
    { "stats",      FLAG,  SETS(stats) },
    { "max-cycles", VALUE, 0, read_max_cycles, "not a number of cycles" },
    { "com",        TEXT,  SETS(com) },
    { "debug",      FLAG,  SETS(debug) },
    { "break",      VALUE, 0, read_break, "more than 16 breakpoints" },
    { "trace",      TEXT,  SETS(trace) },
    { "sym",        TEXT,  SETS(sym) },
    { "help",       HELP,  0, NULL, NULL },
    { "version",    VERSION, 0, NULL, NULL },
};
#undef SETS
// clang-format on
enum { RULE_COUNT = sizeof RULES / sizeof *RULES };
_Static_assert(BOARD_RAM_MIN_KIB == 2 && BOARD_RAM_MAX_KIB == 56 && OPTIONS_BREAKS == 16, "as RULES and USAGE say");

/* The rules as getopt_long reads them; it returns the rule's index + 1, so that 0 in optopt means no option. */
static void getopt_list(struct option *list)
{
    for (int i = 0; i < RULE_COUNT; i++) {
        bool has_value = RULES[i].kind == TEXT || RULES[i].kind == VALUE;
        list[i] = (struct option){ RULES[i].name, has_value ? required_argument : no_argument, NULL, i + 1 };
    }
    list[RULE_COUNT] = (struct option){ NULL, 0, NULL, 0 };
}

/* Ends the text that is printed instead of a run (--help, --version). The result is that of options_read. */
static int printed(void)
{
    return fflush(stdout) ? complain(EXIT_USAGE, "cannot write: %s", strerror(errno)) : -1;
}

static int print_version(void)
{
    printf("skg80 " SKG80_VERSION);
#ifdef SKG80_BUILT_IN_ROM
    printf(", ROM skg.bin, CRC-32 %08X", (unsigned)image_crc32(skg80_rom, BOARD_ROM_SIZE));
#endif
    putchar('\n');
    return printed();
}

/* Carries one option out, its value in optarg. The result is that of options_read. */
static int take(const option_rule *rule, options *o)
{
    switch (rule->kind) {
    case FLAG:
        *(bool *)((char *)o + rule->at) = true;
        return 0;
    case TEXT:
        *(const char **)((char *)o + rule->at) = optarg;
        return 0;
    case VALUE:
        return rule->read(optarg, o) ? 0 : complain(EXIT_USAGE, "--%s %s: %s", rule->name, optarg, rule->wrong);
    case HELP:
        fputs(USAGE, stdout);
        return printed();
    case VERSION:
        return print_version();
    }
    return 0;
}

/* Reports an option that does not exist, or a value for an option that takes none. */
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
    struct option list[RULE_COUNT + 1];
    getopt_list(list);
    *o = (options){ .ram_kib = BOARD_RAM_KIB, .max_cycles = UINT64_MAX, .kind = BOARD_6850, .lag = -1 };
    opterr = 0;
    for (int option; (option = getopt_long(argc, argv, ":", list, NULL)) != -1;) {
        if (option == ':') {
            return complain(EXIT_USAGE, "%s needs a value", argv[optind - 1]);
        }
        if (option == '?') {
            return refuse(argv);
        }
        int done = take(&RULES[option - 1], o);
        if (done) {
            return done;
        }
    }
    if (argc - optind > 1) {
        return complain(EXIT_USAGE, "%s: a second part; skg80 takes one", argv[optind + 1]);
    }
    o->part = argv[optind];
    o->drives = o->drive || o->steps || o->feed > 0 || o->stop_at;
    const char *wrong = misfit(o), *lost = wrong ? NULL : overwritten(o);
    if (lost) {
        return complain(EXIT_USAGE, "%s: one file for two options", lost);
    }
    return wrong ? complain(EXIT_USAGE, "%s", wrong) : 0;
}
