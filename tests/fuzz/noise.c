/* Random text for the teletype. See noise.h. */
#include "noise.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define COUNT(list) (sizeof(list) / sizeof *(list))

/* ---- random numbers ---- */

unsigned noise_random(noise *n, unsigned limit)
{
    n->state = n->state * 6364136223846793005u + 1442695040888963407u;
    return (unsigned)((n->state >> 33) % limit);
}

static bool chance(noise *n, unsigned percent)
{
    return noise_random(n, 100) < percent;
}

/* ---- text ---- */

static void put(noise *n, uint8_t c)
{
    if (n->length < NOISE_ROOM) {
        n->text[n->length++] = c;
    }
}

static void puts_(noise *n, const char *text)
{
    while (*text) {
        put(n, (uint8_t)*text++);
    }
}

static void number(noise *n)
{
    static const char *const odd[] = {
        "0", "1", "2", "10", "20", "30", "50", "90", "180", "360", "-1", "999", "1000", "9999", "10000", "65535", "65536",
        "0.0005", "99999.9995", "100000", "1E38", "2E38", "1E-38", "1E-39", "1E99", ".5", "5.", "0.1", "123456789012",
        "1E", "1.5E-7", "0.00000000000000001", "4294967296", "1E10", "32768", "1.E+5", "00007", "1..2", ".",
    };
    char text[32];
    switch (noise_random(n, 4)) {
    case 0:
        puts_(n, odd[noise_random(n, COUNT(odd))]);
        return;
    case 1:
        snprintf(text, sizeof text, "%u", noise_random(n, 100));
        break;
    case 2:
        snprintf(text, sizeof text, "%u.%u", noise_random(n, 100), noise_random(n, 1000));
        break;
    default:
        snprintf(text, sizeof text, "%u", 10 * noise_random(n, 20));
        break;
    }
    puts_(n, text);
}

static void name(noise *n, const char *letters)
{
    char text[8] = { letters[noise_random(n, (unsigned)strlen(letters))] };
    put(n, (uint8_t)text[0]);
    switch (noise_random(n, 8)) {
    case 0:
    case 1:
        return;
    case 2:
        puts_(n, chance(n, 50) ? "[I]" : "[I+1]");
        return;
    case 3:
        snprintf(text, sizeof text, "%u", noise_random(n, 1001));
        break;
    default:
        snprintf(text, sizeof text, "%u", noise_random(n, 4));
        break;
    }
    puts_(n, text);
}

static const char *const numbers = "ADRIJ", *const points = "PVO", *const circles = "CBT", *const lines = "SXY";

/* An expression of a kind: D number, P point, C circle, S line. The rows are those of language.md, section 2.1; in
 * a row D P C S stand for operands; other characters are literal. */
static void expression(noise *n, char kind, unsigned depth)
{
    static const char *const rows_d[] = {
        "(P,P)", "(P,S)", "(S,P)", "(S,S)", "D*D", "P*P", "D/D", "D+D", "D-D", "-D", "SQR D", "SIN D", "COS D", "TG D",
        "ATG D", "INT D", "ABS D", "K1 P", "K2 P", "K3 C", "K2 S", "(D)", "SQR(D)",
    };
    static const char *const rows_p[] = {
        "(D,D)", "D#D", "P#D", "P#(D:P)", "P#S", "S*S", "S*C", "C*S", "C*C", "C*-C", "P*D", "D*P", "P/D", "P/S", "P+P", "P-P",
        "-P", "(P)",
    };
    static const char *const rows_c[] = { "P:D", "C:D", "C#D", "C#(D:P)", "C/S", "P/P", "-C", "(C)" };
    static const char *const rows_s[] = {
        "S:D", "S:P", "S:C", "P:P", "C:C", "C:P", "P:C", "S#D", "S#(D:P)", "P#P", "S/S", "-S", "(S)", "X:D", "Y:D",
    };
    const char *row;
    if (chance(n, 2)) {
        kind = "DPCS"[noise_random(n, 4)];      /* the wrong kind */
    }
    if (depth == 0) {
        if (kind == 'D') {
            chance(n, 50) ? number(n) : name(n, numbers);
        } else {
            name(n, kind == 'P' ? points : kind == 'C' ? circles : lines);
        }
        return;
    }
    switch (kind) {
    case 'D':
        row = rows_d[noise_random(n, COUNT(rows_d))];
        break;
    case 'P':
        row = rows_p[noise_random(n, COUNT(rows_p))];
        break;
    case 'C':
        row = rows_c[noise_random(n, COUNT(rows_c))];
        break;
    default:
        row = rows_s[noise_random(n, COUNT(rows_s))];
        break;
    }
    /* Operands of a row are single letters; functions (SQR, COS ...) are copied as they are. */
    static const char *const words[] = { "SQR", "SIN", "COS", "TG", "ATG", "INT", "ABS" };
    for (unsigned i = 0; i < COUNT(words); i++) {
        size_t length = strlen(words[i]);
        if (!strncmp(row, words[i], length)) {
            puts_(n, words[i]);
            row += length;
            break;
        }
    }
    for (; *row; row++) {
        if (strchr("DPCS", *row)) {
            expression(n, *row, noise_random(n, depth));
        } else {
            put(n, (uint8_t)*row);
        }
    }
}

/* An expression nested as deep as fits a line. */
static void deep(noise *n)
{
    static const char *const nests[] = { "(", "-(", "A[", "SIN(", "1*(", "2^(", "1/(2+", "((1,2),", "K1(", "1-2*3/(" };
    const char *nest = nests[noise_random(n, COUNT(nests))];
    unsigned levels = 1 + noise_random(n, 110 / (unsigned)strlen(nest));
    for (unsigned i = 0; i < levels; i++) {
        puts_(n, nest);
        if (chance(n, 3)) {
            nest = nests[noise_random(n, COUNT(nests))];
        }
    }
    name(n, "AADIP");
    for (unsigned i = 0; i < levels; i++) {
        put(n, nest[0] == 'A' ? ']' : ')');
    }
}

static void any(noise *n)
{
    if (chance(n, 10)) {
        deep(n);
        return;
    }
    expression(n, "DPCS"[noise_random(n, 4)], noise_random(n, 3));
}

static void route(noise *n)
{
    unsigned items = 1 + noise_random(n, 5);
    if (chance(n, 15)) {
        put(n, ';');
    }
    for (unsigned i = 0; i < items; i++) {
        if (i) {
            put(n, chance(n, 70) ? ',' : ';');
        }
        expression(n, "PPPSSCCD"[noise_random(n, 8)], noise_random(n, 2));
    }
}

static void assignment(noise *n)
{
    unsigned kind = noise_random(n, 4);
    name(n, (const char *const[]){ "ADRIJ", "PV", "CBT", "S" }[kind]);
    put(n, '=');
    expression(n, "DPCS"[kind], noise_random(n, 4));
}

static void line_number(noise *n)
{
    char text[8];
    snprintf(text, sizeof text, "%u", 10 * (1 + noise_random(n, 20)));
    puts_(n, text);
}

static void list(noise *n, void (*item)(noise *))
{
    do {
        item(n);
    } while (chance(n, 40) && (put(n, ','), true));
}

static void any_name(noise *n)
{
    name(n, chance(n, 5) ? "XYO" : "ADRIJPVCBTS");
}

static void text_or_value(noise *n)
{
    chance(n, 20) ? puts_(n, "\"a, B;\"") : any(n);
}

void noise_statement(noise *n)
{
    switch (noise_random(n, 27)) {
    default:
        assignment(n);
        break;
    case 0:
        puts_(n, "FROM ");
        expression(n, 'P', noise_random(n, 3));
        break;
    case 1: case 2: case 3: case 4: case 5:
        puts_(n, "CUT ");
        route(n);
        break;
    case 6: case 7:
        puts_(n, "BACK");
        break;
    case 8:
        puts_(n, "END");
        break;
    case 9:
        puts_(n, "REM  any Text \"");
        break;
    case 10:
        puts_(n, "PRINT ");
        list(n, text_or_value);
        break;
    case 11:
        puts_(n, "GOTO ");
        line_number(n);
        break;
    case 12:
        puts_(n, "IF ");
        expression(n, 'D', 1);
        puts_(n, (const char *const[]){ "=", "<>", "<", ">", "<=", ">=" }[noise_random(n, 6)]);
        expression(n, 'D', 1);
        puts_(n, " GOTO ");
        line_number(n);
        break;
    case 13:
        puts_(n, "GOSUB ");
        line_number(n);
        break;
    case 14:
        puts_(n, "RETURN");
        break;
    case 15:
        puts_(n, "READ ");
        list(n, any_name);
        break;
    case 16:
        puts_(n, "DATA ");
        list(n, any);
        break;
    case 17:
        puts_(n, "RESTORE ");
        if (chance(n, 50)) {
            line_number(n);
        }
        break;
    case 18:
        puts_(n, "INPUT ");
        list(n, any_name);
        break;
    case 19:
        puts_(n, "SCALE ");
        expression(n, 'D', noise_random(n, 2));
        break;
    case 20:
        puts_(n, chance(n, 20) ? "SYM ;" : "SYM ");
        expression(n, 'S', noise_random(n, 2));
        break;
    case 21:
        puts_(n, "REP ");
        expression(n, 'D', 0);
        put(n, ',');
        expression(n, 'D', 0);
        if (chance(n, 30)) {
            put(n, ':');
            expression(n, 'P', 0);
        }
        break;
    case 22:
        puts_(n, "RECUT");
        break;
    case 23:
        puts_(n, "FIT ");
        expression(n, 'P', 1);
        if (chance(n, 40)) {
            put(n, ',');
            expression(n, 'D', 1);
        }
        break;
    case 24:
        puts_(n, "TOL ");
        expression(n, 'D', noise_random(n, 2));
        break;
    }
}

void noise_program(noise *n, unsigned lines_)
{
    for (unsigned i = 0; i < lines_; i++) {
        line_number(n);
        put(n, ' ');
        noise_statement(n);
        put(n, '\r');
    }
}

void noise_command(noise *n)
{
    static const char *const commands[] = {
        "RUN\r", "RUN\r", "RUN\r", "RUN 50\r", "LIST\r", "LIST 50\r", "LIST 20,90\r", "SAVE\r", "SAVE 10,50\r", "FREE\r", "GOTO 10\r",
        "GOSUB 10\r", "NEW\r", "LOAD\r", "RUN 65536\r", "LIST 0,0\r", "\r", "10\r", "50\r", "LIST 5,4\r", "CONT\r",
    };
    puts_(n, commands[noise_random(n, COUNT(commands))]);
}

static void token(noise *n)
{
    static const char *const words[] = {
        "SQR ", "SIN ", "COS ", "TG ", "ATG ", "ABS ", "INT ", "K1 ", "K2 ", "K3 ", "FROM ", "CUT ", "BACK", "END", "REM ",
        "PRINT ", "GOTO ", "IF ", "GOSUB ", "RETURN", "READ ", "DATA ", "RESTORE ", "INPUT ", "SCALE ", "SYM ", "REP ",
        "RECUT", "FIT ", "TOL ", "RUN", "LIST ", "FREE", "SIN", "R E P", "print ", "sIn ",
    };
    static const char *const signs[] = {
        "(", "(", ")", ")", "[", "]", ",", ",", ";", ":", "#", "*", "/", "+", "-", "=", "=", "<", ">", "<=", "<>", "\"", "^",
        "!", "?", "@", "{", "%", " ", "\t", "((((((((", "))))))))", "--------", "-(-(-(-(", "A[A[A[A[",
    };
    switch (noise_random(n, 4)) {
    case 0:
        puts_(n, words[noise_random(n, COUNT(words))]);
        break;
    case 1:
        puts_(n, signs[noise_random(n, COUNT(signs))]);
        break;
    case 2:
        name(n, "ADRIJPVOCBTSXYZQ");
        break;
    default:
        number(n);
        break;
    }
}

void noise_tokens(noise *n, unsigned count)
{
    if (chance(n, 40)) {
        line_number(n);
    }
    while (count--) {
        token(n);
    }
    put(n, '\r');
}

void noise_bytes(noise *n, unsigned count)
{
    while (count--) {
        put(n, (uint8_t)noise_random(n, 256));
    }
}

void noise_example(noise *n, unsigned count)
{
    static const char letters[] = "0123456789.,;:#*/+-=()[]<>ADRIJPVOCBTSXYEK \"";
    size_t first = noise_random(n, (unsigned)n->line_count);
    for (unsigned i = 0; i < count; i++) {
        size_t from = n->length;
        puts_(n, n->lines[(first + i) % n->line_count]);
        for (unsigned changes = chance(n, 60) ? 0 : 1 + noise_random(n, 3); changes; changes--) {
            size_t length = n->length - from, at = from + noise_random(n, (unsigned)length + 1);
            switch (noise_random(n, 3)) {
            case 0:         /* a character lost */
                if (at < n->length) {
                    memmove(n->text + at, n->text + at + 1, n->length - at - 1);
                    n->length--;
                }
                break;
            case 1:         /* changed */
                if (at < n->length) {
                    n->text[at] = (uint8_t)letters[noise_random(n, sizeof letters - 1)];
                }
                break;
            default:        /* the rest comes from another line */
                n->length = at;
                const char *other = n->lines[noise_random(n, (unsigned)n->line_count)];
                puts_(n, other + noise_random(n, (unsigned)strlen(other) + 1));
                break;
            }
        }
        put(n, '\r');
    }
}

void noise_line_noise(noise *n, size_t from)
{
    static const uint8_t controls[] = { 0, 3, 7, 8, 9, 10, 13, 17, 18, 19, 20, 21, 26, 27, 127, 17, 8, 127 };
    for (size_t i = from; i < n->length; i++) {
        if (!chance(n, 3)) {
            continue;
        }
        if (chance(n, 50)) {
            n->text[i] = controls[noise_random(n, sizeof controls)];
        } else {
            n->text[i] ^= (uint8_t)(1 << noise_random(n, 8));
        }
    }
}

/* The line begins with letters that keep it from storing, whatever follows: no digit, no NEW, no LOAD. */
void noise_harmless(noise *n)
{
    size_t from = n->length;
    if (chance(n, 50)) {
        noise_statement(n);
    } else {
        puts_(n, (const char *const[]){ "PRINT ", "CUT ", "A=", "P1=", "IF ", "FROM ", "(", "?", "RUN ", "LIST " }[noise_random(n, 10)]);
        for (unsigned count = noise_random(n, 12); count; count--) {
            token(n);
        }
    }
    /* Editing keys delete a character or two before them, never the line's first. */
    size_t length = n->length - from;
    if (length > 8 && chance(n, 20)) {
        put(n, chance(n, 50) ? 8 : 127);
        put(n, 'A');
    }
    if (chance(n, 5)) {
        put(n, 3);          /* ctrl-C drops the line so far, and only a CR follows */
    }
    put(n, '\r');
}

/* ---- examples ---- */

bool noise_read(noise *n, const char *path)
{
    char line[512];
    FILE *file = fopen(path, "r");
    if (!file) {
        return false;
    }
    while (fgets(line, sizeof line, file)) {
        line[strcspn(line, "\r\n")] = '\0';
        char **grown = realloc(n->lines, (n->line_count + 1) * sizeof *grown);
        if (grown) {
            n->lines = grown;
        }
        char *copy = malloc(strlen(line) + 1);
        if (!grown || !copy) {
            free(copy);
            fclose(file);
            return false;
        }
        n->lines[n->line_count++] = strcpy(copy, line);
    }
    fclose(file);
    return true;
}

void noise_free(noise *n)
{
    for (size_t i = 0; i < n->line_count; i++) {
        free(n->lines[i]);
    }
    free(n->lines);
}
