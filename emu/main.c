/* skg80: the SKG board in a terminal
 *
 *      skg80 [options]             the terminal is the teletype; ctrl-] leaves, ctrl-\ resets
 *      skg80 [options] part.skg    LOAD, RUN; punch to standard output, paper to standard error
 *      skg80 --com FILE            a CP/M program on a bare 8080
 *
 *      exit    0   done
 *              1   the run ended in ERR, a line of a pipe was answered with ERR, INPUT found no answer, LOAD no tape, or
 *                  the machine halted
 *              2   wrong usage, a file that cannot be read or written, or a ROM that does not fit the board
 *              3   --max-cycles were not enough
 *
 * The teletype alone has no punch of its own in a terminal: without --punch FILE the punched tape is lost, with one
 * message. (The firmware lists every block on the paper anyway.)
 *
 * With --punch-pty the punch and the reader are a pseudo-terminal with a machine behind it; standard output has its
 * name (behind that of --pty), and the tape goes to the machine and to --punch FILE, not to standard output. A part is
 * read before any character of the machine's. Its characters wait until the board asks for them.
 *
 * The drive's options also type for the operator: with a part, DRIVE 1 before RUN, and a key at each `D`.
 *
 * NOT IMPLEMENTED: the punch's own speed; saving the state of the machine.
 */
#include "board.h"
#include "com.h"
#include "complain.h"
#include "debug.h"
#include "drawn.h"
#include "image.h"
#include "operator.h"
#include "options.h"
#include "output.h"
#include "session.h"
#include "signs.h"
#include "symbols.h"
#include "terminal.h"

#include <ctype.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum {
    FILE_LIMIT = 16 << 20,          /* bytes; a part or a list of answers is a few thousand */
    LINE_PATIENCE_MS = 5000,        /* a machine may leave its line full so long */
    CTRL_C = 0x03,
    CTRL_S = 0x13,
    CTRL_Z = 0x1a                   /* nothing follows on a tape of program lines */
};

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
        code = complain(EXIT_ERR, "the program calls BDOS function %d, which skg80 does not have", c->bc & 0xff);
    }
    if (o->stats) {
        output_counts(c->cycles, c->instructions);
    }
    free(c);
    free(program);
    return code;
}

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
    board_rom(s->board, skg80_rom, BOARD_ROM_SIZE);
    return 0;
#else
    return complain(EXIT_USAGE, "built without a ROM: give one with --rom FILE");
#endif
}

/* The line to type once a part is loaded: RUN. A part without line numbers runs while it loads: then NULL if it ends in
 * END, else END, so that an open route gets its last block. */
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

/* Replaces signs in other forms by the ASCII ones, in place, and refuses other characters. In a file, not a tape, also
 * those that would stop the board, and what is behind ctrl-Z stays: so does `skg` (board_text of tools/skg/files.py). */
static int take_signs(const char *path, uint8_t *bytes, size_t *length, bool is_tape)
{
    unsigned line = 1, column = 1;
    size_t kept = 0, at = 0;
    for (size_t used; at < *length && (is_tape || bytes[at] != CTRL_Z); at += used) {
        char shown[SIGNS_SHOWN];
        int sign = signs_read(bytes + at, *length - at, &used);
        if (!is_tape && (sign == CTRL_C || sign == CTRL_S)) {
            return complain(EXIT_USAGE, "%s: line %u, column %u: a ctrl-%s: delete it", path, line, column,
                            sign == CTRL_C ? "C breaks LOAD off" : "S holds the board");
        }
        if (sign < 0) {
            signs_show(bytes + at, used, shown);
            return complain(EXIT_USAGE, "%s: line %u, column %u: %s is not ASCII", path, line, column, shown);
        }
        bool ends = sign == '\n' || (sign == '\r' && bytes[at + 1] != '\n');
        line += ends;
        column = ends ? 1 : column + 1;
        bytes[kept++] = (uint8_t)sign;
    }
    memmove(bytes + kept, bytes + at, *length + 1 - at);
    *length -= at - kept;
    return 0;
}

/* Reads a text for the board's keyboard or reader, where it may be a tape with parity; a mark of UTF-8 is dropped. NULL
 * on failure, with the exit code. */
static uint8_t *read_text(const char *path, size_t *length, bool is_tape, int *code)
{
    static const char mark[] = "\xef\xbb\xbf";
    enum { PARITY = 0x80 };
    char error[256];
    uint8_t *bytes = image_read(path, FILE_LIMIT, length, error, sizeof error);
    if (!bytes) {
        *code = complain(EXIT_USAGE, "%s", error);
        return NULL;
    }
    if (signs_have_parity(bytes, *length)) {
        for (size_t i = 0; i < *length; i++) {
            bytes[i] &= (uint8_t)~PARITY;
        }
    }
    if (*length >= sizeof mark - 1 && !memcmp(bytes, mark, sizeof mark - 1)) {
        *length -= sizeof mark - 1;
        memmove(bytes, bytes + sizeof mark - 1, *length + 1);
    }
    *code = take_signs(path, bytes, length, is_tape);
    if (*code) {
        free(bytes);
        return NULL;
    }
    return bytes;
}

/* Puts a tape into the reader, with a line end behind a last line that has none. */
static int set_tape(session *s, const char *path)
{
    size_t length;
    int code;
    uint8_t *bytes = read_text(path, &length, path == s->o.tape, &code);
    if (!bytes) {
        return code;
    }
    /* (an empty file becomes an empty line: LOAD waits for a first character) */
    bool ended = length && (bytes[length - 1] == '\n' || bytes[length - 1] == '\r');
    s->rest = rest_of(bytes, length);
    bool fits = board_tape(s->board, bytes, length) && (ended || board_tape(s->board, (const uint8_t *)"\n", 1));
    free(bytes);
    return fits ? 0 : complain(EXIT_ERR, "out of memory");
}

static const char NAMELESS[] = ": no .sym file is beside the ROM, and no --sym FILE is given";

/* Reads the names of the ROM: from --sym, from the file beside --rom, or built in. Having none is no error. */
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

static int open_output(outfile *file, const char *path)
{
    return path && !outfile_open(file, path) ? complain(EXIT_USAGE, "%s: %s", path, strerror(errno)) : 0;
}

/* Opens the debugger: --debug, --break, --trace. */
static int set_debug(session *s)
{
    const options *o = &s->o;
    bool talks = o->debug || o->break_count;
    if (!talks && !o->trace) {
        return o->sym ? complain(EXIT_USAGE, "--sym goes with --debug, --break or --trace") : 0;
    }
    if (talks && !o->part && !o->pty && !isatty(STDIN_FILENO)) {
        return complain(EXIT_USAGE, "--debug and --break need a terminal, a part or --pty");
    }
    int code = set_names(s);
    code = code ? code : open_output(&s->trace, o->trace);
    if (code) {
        return code;
    }
    s->debug = debug_new(s->board, s->names, s->trace.file, o->debug);
    if (!s->debug) {
        return complain(EXIT_ERR, "out of memory");
    }
    for (unsigned i = 0; i < o->break_count; i++) {
        if (!debug_break(s->debug, o->breaks[i])) {
            return complain(EXIT_USAGE, "--break %s: no such place (a label, or a hexadecimal address)%s", o->breaks[i],
                            s->names ? "" : NAMELESS);
        }
    }
    if (!s->names) {
        remark("addresses are shown without names%s", NAMELESS);
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
    s->board->reading = (board_sender){ .cps = s->o.reader_cps, .lag = s->o.lag };
    s->board->typing = (board_sender){ .cps = s->o.keyboard_cps, .lag = s->o.lag };
    s->board->punch_tty |= s->o.punch_tty;
    if (s->o.tty_ports != s->o.aux_ports) {
        s->board->tty_ports = s->o.tty_ports;
        s->board->aux_ports = s->o.aux_ports;
    }
    s->board->paper = output_print;
    s->board->punch = output_punch;
    s->board->user = s;
    s->board->drive.feed_hz = s->o.feed;
    s->board->drive.stop_at = s->o.stop_at;
    s->board->drive.stop_stays = s->o.stop_stays;
    s->board->drive.step = output_step;
    i8080_watch(&s->board->cpu, s->o.stats, 0, BOARD_ROM_SIZE - 1);
    s->board->cpu.written = s->written;
    pacer_start(&s->pacer, mhz * 1e6, 0);
    return set_rom(s);
}

/* Opens the files of the drive's steps. */
static int set_drive(session *s)
{
    int code = open_output(&s->steps, s->o.steps);
    code = code ? code : open_output(&s->picture, s->o.drive);
    if (!code && s->picture.file && !(s->drawn = drawn_new())) {
        return complain(EXIT_ERR, "out of memory");
    }
    return code;
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

/* Opens the line to the machine, with --punch-pty. */
static int offer_line(session *s)
{
    int code = s->o.punch_pty ? offer(&s->line) : 0;
    s->line.patience = LINE_PATIENCE_MS;
    return code;
}

static int with_part(session *s)
{
    size_t length;
    int code = 0;
    uint8_t *answers = NULL;
    if (s->o.input && !(answers = read_text(s->o.input, &length, false, &code))) {
        return code;
    }
    if (answers) {
        answers[strcspn((char *)answers, "\x1a")] = '\0';
    }
    code = set_tape(s, s->o.part);
    code = code ? code : open_output(&s->tty, s->o.tty);
    code = code ? code : open_output(&s->tape, s->o.punch);
    s->paper = s->tty.file ? s->tty.file : stderr;
    s->punch = s->tape.file ? s->tape.file : s->o.punch_pty ? NULL : stdout;
    complain_beside(s->paper == stderr ? s->board : NULL);
    code = code ? code : offer_line(s);
    s->began = !code;
    code = code ? code : operator_part(s, answers ? (const char *)answers : "");
    if (s->o.punch_pty && *s->line.name && !s->line.deaf) {
        terminal_drain(&s->line);
        s->failed = s->line.deaf ? ETIMEDOUT : s->failed;
    }
    free(answers);
    return code;
}

static int with_terminal(session *s)
{
    int code = s->o.tape ? set_tape(s, s->o.tape) : 0;
    code = code ? code : open_output(&s->tty, s->o.tty);
    code = code ? code : open_output(&s->tape, s->o.punch);
    s->punch = s->tape.file;
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
    s->terminal.copy = s->tty.file;
    terminal_catch_reset();
    if (s->terminal.leaves) {
        s->terminal.stops = s->o.debug || s->o.break_count;
        remark("ctrl-] leaves, ctrl-\\ resets%s",
               s->terminal.stops ? ", ctrl-^ stops the board and asks what to do" : "");
    } else if (s->o.pty && isatty(STDERR_FILENO)) {
        remark("ctrl-C ends this; kill -USR1 %ld resets", (long)getpid());
    }
    complain_beside(s->o.pty ? NULL : s->board);
    s->began = true;
    code = operator_terminal(s);
    complain_end_line(); /* the shell's prompt gets a line of its own */
    return code;
}

int main(int argc, char **argv)
{
    static session s;
    if (!terminal_open_streams()) {
        return EXIT_USAGE;
    }
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
    bool known = false;
    if (!code) {
        code = s.o.part ? with_part(&s) : with_terminal(&s);
        known = s.failed && code;
        output_flush(&s);
    }
    if (s.began) {
        output_drive(&s);
    }
    bool is_whole = output_end(&s);
    if (s.failed && !known) {
        code = output_failure(&s);
    }
    code = code || is_whole ? code : EXIT_ERR;
    if (s.began && s.o.stats) {
        output_stats(&s);
    }
    drawn_free(s.drawn);
    debug_free(s.debug);
    symbols_free(s.names);
    board_free(s.board);
    return !code && ferror(stderr) ? EXIT_USAGE : code;
}
