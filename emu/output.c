#include "output.h"

#include "complain.h"

#include <ctype.h>
#include <errno.h>
#include <string.h>

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

/* Keeps the paper's present line, whether the one above is an error's, and whether the prompt followed one. */
static void follow(session *s, uint8_t c)
{
    if (c == '\r' || c == '\n') {
        if (s->line_length) {
            s->printing[s->line_length < ERROR_LINE ? s->line_length : ERROR_LINE] = '\0';
            s->below_error = s->line_length <= ERROR_LINE && is_error(s->printing);
        }
        s->line_length = 0;
    } else if (c >= ' ') {
        /* (PRINT may write the same words: the prompt does not follow them) */
        s->refused |= c == '>' && !s->line_length && s->below_error;
        if (s->line_length < ERROR_LINE) {
            s->printing[s->line_length] = (char)c;
        }
        s->line_length++;
    }
}

void output_print(void *user, uint8_t c)
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

void output_punch(void *user, uint8_t byte)
{
    session *s = user;
    s->punched_nowhere = !s->punch && !s->o.punch_pty;
    if (s->punch) {
        put(s, byte, s->punch);
        if (!outfile_punched(&s->tape, byte)) {
            s->failed = errno;
        }
    }
    if (s->o.punch_pty) {
        terminal_print(&s->line, byte);
        s->failed = s->line.deaf ? ETIMEDOUT : s->failed;
    }
}

void output_step(void *user, uint8_t value, uint64_t cycles)
{
    session *s = user;
    (void)cycles;
    if (s->steps.file) {
        put(s, value, s->steps.file);
    }
    if (s->drawn && !drawn_step(s->drawn, value)) {
        s->failed = ENOMEM;
    }
}

/* Writes the picture of the steps, in place of an earlier one. */
static void draw(session *s)
{
    if (!outfile_again(&s->picture) || !drawn_write(s->drawn, s->picture.file) || !outfile_keep(&s->picture)) {
        s->failed = errno;
    }
    s->steps_drawn = s->board->drive.steps;
}

/* Gives a file that is not empty its name. */
static void settle(session *s, outfile *f)
{
    if (f->file && !f->kept && ftell(f->file) > 0 && !outfile_keep(f)) {
        s->failed = errno;
    }
}

void output_settle(session *s)
{
    settle(s, &s->tty);
    settle(s, &s->steps);
    settle(s, &s->trace);
    /* (what is no plain file gets one picture alone) */
    if (s->picture.part && s->steps_drawn != s->board->drive.steps) {
        draw(s);
    }
}

bool output_end(session *s)
{
    outfile *const files[] = { &s->tape, &s->tty, &s->steps, &s->trace, &s->picture };
    if (s->began && s->picture.file) {
        draw(s);
    }
    bool is_whole = true;
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        outfile *f = files[i];
        if (s->began && !s->failed && f != &s->tape && !outfile_keep(f)) {
            s->failed = errno;
        }
        const char *part;
        if (!outfile_leave(f, &part) && !s->failed) {
            s->failed = errno;
        }
        if (part) {
            remark(
                f == &s->tape ? "%s: what was punched so far, without the tape's end" : "%s: what was written so far",
                part);
            is_whole = is_whole && f != &s->tape;
        }
    }
    return is_whole;
}

bool output_flush(session *s)
{
    FILE *const files[] = { s->paper, s->punch, s->steps.file, s->terminal.copy };
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        if (files[i] && fflush(files[i])) {
            s->failed = errno;
        }
    }
    s->failed = s->failed ? s->failed : s->terminal.failed;
    s->failed = s->failed || !s->debug ? s->failed : debug_failure(s->debug);
    return !s->failed;
}

int output_failure(const session *s)
{
    if (s->line.deaf) {
        return complain(EXIT_USAGE, "%s: no program reads the punched tape", s->line.name);
    }
    return complain(EXIT_USAGE, "cannot write: %s", strerror(s->failed));
}

void output_counts(uint64_t cycles, uint64_t instructions)
{
    fprintf(stderr, "cycles        %llu\ninstructions  %llu\nseconds       %.6f at %d MHz\n",
            (unsigned long long)cycles, (unsigned long long)instructions, (double)cycles / BOARD_HZ,
            BOARD_HZ / 1000000);
}

/* Prints the largest piece of RAM not written since the first prompt: the gap between program and variables. */
static void print_untouched(const session *s, unsigned end)
{
    unsigned start = board_ram_start(s->o.kind), first = end, length = 0;
    for (unsigned at = start, run = 0; at < end; at++) {
        run = s->written[at] ? 0 : run + 1;
        if (run > length) {
            length = run;
            first = at + 1 - run;
        }
    }
    fprintf(stderr, "RAM           %04X to %04X, untouched %04X to %04X: %u bytes\n", start, end - 1, first,
            first + length - 1, length);
}

void output_stats(const session *s)
{
    const i8080 *c = &s->board->cpu;
    complain_end_line();
    output_counts(c->cycles, c->instructions);
    print_untouched(s, board_ram_end(s->o.kind, s->o.ram_kib));
    fprintf(stderr, "stack         down to %04X\n", c->lowest_sp);
    const drive *d = &s->board->drive;
    if (d->gaps) {
        fprintf(stderr, "drive         %llu steps, from one to the next %.1f cycles, at most %llu\n",
                (unsigned long long)d->steps, (double)d->gap_cycles / (double)d->gaps,
                (unsigned long long)d->longest_gap);
    }
}

void output_drive(const session *s)
{
    const drive *d = &s->board->drive;
    if (!d->steps && s->o.drives) {
        remark("the drive was given no step");
    }
    if (d->hasty) {
        remark("%llu of the drive's steps: the direction was set with the pulse or changed during it; a motor may miss "
               "these steps",
               (unsigned long long)d->hasty);
    }
}
