/* fuzz: the ROM under an operator who types anything at all
 *
 *      fuzz [options] EXAMPLE...       some of the noise is made of the examples' lines
 *        --rom FILE --board KIND --punch-tty       the board (6850), as for skg80
 *        --sym FILE                  symbols: where stack and program are
 *        --lst FILE                  listing: where instructions begin (without it, anywhere in the ROM)
 *        --bytes N                   how much to type
 *        --seed S --session N        the first session of the run; a failure names both, to see it again
 *
 * A session is one board, switched on, typed at in rounds, reset now and then. After every round:
 *
 * - every instruction fetched began where the listing has one (so none in RAM, none in data), never at 0000 but for a
 *   reset, no HLT, and nothing was ever written to the ROM;
 * - SP is in STKLOW...STKTOP: whenever the board is looked at, and in every fourth session, which runs in the core's
 *   slow loop with everything watched, after every push and call;
 * - after ctrl-C there is the prompt within PATIENCE cycles, and after a CR again;
 * - the program in memory is sound: records with check sums and ascending numbers, a zero length at PEND, below VBOT;
 * - lines that store nothing change no byte of the program, nor the output of LIST; a reset at the prompt
 *   neither, nor the variables;
 * - the paper gets printing characters and the few controls that the firmware uses.
 *
 * Exit 0, or 1 with the reason and the last characters typed.
 */
#include "../../emu/board.h"
#include "../../emu/image.h"
#include "noise.h"

#include <ctype.h>
#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    CTRL_C = 3,
    PATIENCE = 40000000,        /* cycles from ctrl-C to the prompt: one statement, at most */
    SLICE = 300000,             /* cycles between two looks at the board */
    ROUNDS = 300,               /* in a session */
    PAPER = 4096                /* last characters of the paper that are kept */
};

typedef struct {
    uint16_t pend, vbot, vtop, prog, stklow, stktop;
} places;

typedef struct {
    places at;
    bool instruction[BOARD_ROM_SIZE];
    uint8_t rom[BOARD_ROM_SIZE];
    board_kind kind;
    bool punch_tty;
    uint64_t seed, session, round;
    noise noise;
    board *board;
    /* The paper since it was last cleared: its length and a hash; its last characters. */
    uint64_t printed, hash;
    uint8_t paper[PAPER];
    uint16_t lowest;            /* on the stack, of all sessions */
    uint64_t longest;           /* cycles from ctrl-C to the prompt */
    uint64_t queued, dropped;   /* bytes to type, and bytes that never reached the board */
    uint64_t resets, renewed, rounds, instructions, compared;
} fuzz;

static _Noreturn void fail(const fuzz *f, const char *why, unsigned value)
{
    const i8080 *c = &f->board->cpu;
    printf("\nseed %llu session %llu round %llu: %s (%04X)\nPC %04X SP %04X\n", (unsigned long long)f->seed,
           (unsigned long long)f->session, (unsigned long long)f->round, why, value, c->pc, c->sp);
    printf("typed in this round:\n");
    for (size_t i = 0; i < f->noise.length; i++) {
        uint8_t byte = f->noise.text[i];
        printf(byte == '\r' ? "\\r\n" : byte < ' ' || byte > '~' || byte == '\\' ? "\\x%02x" : "%c", byte);
    }
    printf("\nthe paper's end:\n");
    uint64_t first = f->printed > PAPER ? f->printed - PAPER : 0;
    for (uint64_t i = first; i < f->printed; i++) {
        putchar(f->paper[i % PAPER]);
    }
    putchar('\n');
    exit(1);
}

/* ---- the outside of the board ---- */

static void on_paper(void *user, uint8_t c)
{
    fuzz *f = user;
    f->paper[f->printed++ % PAPER] = c;
    f->hash = (f->hash ^ c) * 1099511628211u;
    if (c < ' ' ? !memchr("\0\a\b\r\n\x11\x12\x13\x14\x1a", c, 10) : c > '~') {
        fail(f, "on the paper", c);
    }
}

static void clear_paper(fuzz *f)
{
    f->printed = f->hash = 0;
}

static bool on_the_paper(const fuzz *f, const char *word)
{
    size_t length = f->printed < PAPER ? (size_t)f->printed : PAPER, wanted = strlen(word);
    for (size_t i = 0; i + wanted <= length; i++) {
        if (!memcmp(f->paper + i, word, wanted)) {
            return true;
        }
    }
    return false;
}

static void type(fuzz *f, const uint8_t *bytes, size_t length)
{
    f->queued += length;
    if (!board_type(f->board, bytes, length)) {
        abort();
    }
}

/* ---- checks ---- */

static unsigned word(const fuzz *f, uint16_t address)
{
    return i8080_peek(&f->board->cpu, address) | i8080_peek(&f->board->cpu, (uint16_t)(address + 1)) << 8;
}

/* Runs after every round, and before any other fault is reported, since that is likely to come from this one. */
static void check_fetches(const fuzz *f)
{
    const i8080 *c = &f->board->cpu;
    for (unsigned at = 1; at < I8080_SPACE; at++) {
        if (i8080_fetched(c, (uint16_t)at) && !(at < BOARD_ROM_SIZE && f->instruction[at])) {
            fail(f, "fetched where no instruction is", at);
        }
    }
}

/* After every slice. */
static void check_processor(fuzz *f, board_reason reason)
{
    const i8080 *c = &f->board->cpu;
    if (reason == BOARD_HALT || reason == BOARD_BREAK || c->rom_writes || c->sp < f->at.stklow
        || c->sp > f->at.stktop) {
        check_fetches(f);
    }
    if (reason == BOARD_HALT) {
        fail(f, "HLT", c->pc);
    }
    if (reason == BOARD_BREAK) {
        fail(f, "came to 0000 without a reset", c->pc);
    }
    if (c->rom_writes) {
        fail(f, "wrote to the ROM", c->rom_written);
    }
    if (c->sp < f->at.stklow || c->sp > f->at.stktop) {
        fail(f, "SP out of its room", c->sp);
    }
}

/* After every round, at the prompt. */
static void check_watched(fuzz *f)
{
    const i8080 *c = &f->board->cpu;
    if (c->fetches_outside) {
        fail(f, "fetched out of the ROM", c->first_outside);
    }
    if (c->lowest_sp < f->at.stklow) {
        fail(f, "the stack left its room", c->lowest_sp);
    }
    f->lowest = c->lowest_sp < f->lowest ? c->lowest_sp : f->lowest;
}

/* The first address of the program with an error; 0: none. */
static unsigned unsound(const fuzz *f)
{
    const i8080 *c = &f->board->cpu;
    unsigned at = f->at.prog, pend = word(f, f->at.pend), vbot = word(f, f->at.vbot), vtop = word(f, f->at.vtop);
    unsigned last = 0;
    if (!(pend < vbot && vbot <= vtop && i8080_peek(c, (uint16_t)vtop) == 0)) {
        fail(f, "PEND, VBOT, VTOP", pend);
    }
    while (at < pend) {
        unsigned length = i8080_peek(c, (uint16_t)at), line = word(f, (uint16_t)(at + 1)), sum = 0;
        for (unsigned i = 0; i < length; i++) {
            sum += i8080_peek(c, (uint16_t)(at + i));
        }
        if (length < 6 || line <= last || line > 9999 || sum & 0xff || i8080_peek(c, (uint16_t)(at + length - 2))) {
            return at;
        }
        last = line;
        at += length;
    }
    return at == pend && !i8080_peek(c, (uint16_t)at) ? 0 : at;
}

/* ---- the operator ---- */

static board_reason run(fuzz *f, uint64_t cycles)
{
    board_reason reason = BOARD_CYCLES;
    for (uint64_t end = f->board->cpu.cycles + cycles; reason == BOARD_CYCLES && f->board->cpu.cycles < end;) {
        reason = board_run(f->board, SLICE);
        check_processor(f, reason);
    }
    return reason;
}

static void to_prompt(fuzz *f)
{
    if (run(f, PATIENCE) != BOARD_PROMPT) {
        if (!f->board->cpu.watching) {
            check_fetches(f);
        }
        fail(f, "no prompt", 0);
    }
}

static void reset(fuzz *f)
{
    i8080 *c = &f->board->cpu;
    board_reset(f->board);
    i8080_break(c, 0, false);
    board_run(f->board, 1);
    i8080_break(c, 0, true);
    c->sp = f->at.stktop;       /* (as RESET will set it; after power-on it is random) */
    f->resets++;
}

/* Drops typed characters, sends ctrl-C, and checks that the prompt comes, also after a CR. */
static void break_in(fuzz *f)
{
    f->dropped += f->board->typed.end - f->board->typed.first;
    board_forget_typed(f->board);
    if (!board_press(f->board, CTRL_C)) {
        abort();
    }
    uint64_t since = f->board->cpu.cycles;
    to_prompt(f);
    uint64_t took = f->board->cpu.cycles - since;
    f->longest = took > f->longest ? took : f->longest;
    type(f, (const uint8_t *)"\r", 1);
    to_prompt(f);
}

/* Copies the memory from..to. */
static uint8_t *copy(const fuzz *f, unsigned from, unsigned to)
{
    uint8_t *bytes = malloc(to - from + 1);
    if (!bytes) {
        abort();
    }
    memcpy(bytes, f->board->cpu.mem + from, to - from + 1);
    return bytes;
}

static uint64_t listing(fuzz *f)
{
    clear_paper(f);
    type(f, (const uint8_t *)"LIST\r", 5);
    to_prompt(f);
    return f->hash;
}

/* Types lines that store nothing; the program and the output of LIST must stay the same. */
static void harmless_round(fuzz *f)
{
    noise *n = &f->noise;
    unsigned pend = word(f, f->at.pend);
    uint8_t *before = copy(f, f->at.prog, pend);
    uint64_t listed = listing(f);
    clear_paper(f);
    for (unsigned lines = 1 + noise_random(n, 30); lines; lines--) {
        noise_harmless(n);
    }
    type(f, n->text, n->length);
    run(f, 200000 + noise_random(n, 4000000));
    break_in(f);
    check_fetches(f);
    if (word(f, f->at.pend) != pend || memcmp(before, f->board->cpu.mem + f->at.prog, pend - f->at.prog + 1)) {
        fail(f, "the program has changed", word(f, f->at.pend));
    }
    free(before);
    if (listing(f) != listed) {
        check_fetches(f);
        fail(f, "LIST has changed", 0);
    }
    f->compared++;
}

/* A reset at the prompt keeps program and variables. */
static void reset_round(fuzz *f)
{
    unsigned pend = word(f, f->at.pend), vbot = word(f, f->at.vbot), vtop = word(f, f->at.vtop);
    uint8_t *program = copy(f, f->at.prog, pend), *variables = copy(f, vbot, vtop);
    clear_paper(f);
    reset(f);
    to_prompt(f);
    if (on_the_paper(f, "DAMAGED") || word(f, f->at.pend) != pend || word(f, f->at.vbot) != vbot
        || memcmp(program, f->board->cpu.mem + f->at.prog, pend - f->at.prog + 1)
        || memcmp(variables, f->board->cpu.mem + vbot, vtop - vbot + 1)) {
        fail(f, "a reset at the prompt lost something", word(f, f->at.pend));
    }
    free(program);
    free(variables);
}

/* Resets at a random moment. When it cuts the storing of a line short, half the program may have been moved, and a
 * check sum of 8 bits lets one garbled line in 256 pass: then the operator, who sees it in LIST, begins anew. */
static void reset_in_the_middle(fuzz *f)
{
    reset(f);
    break_in(f);
    if (unsound(f)) {
        type(f, (const uint8_t *)"NEW\r", 4);
        to_prompt(f);
        f->renewed++;
    }
    type(f, (const uint8_t *)"RUN\r", 4);
}

static void any_round(fuzz *f)
{
    noise *n = &f->noise;
    switch (noise_random(n, 8)) {
    case 0:
        noise_bytes(n, noise_random(n, 600));
        break;
    case 1:
    case 2:
        for (unsigned lines = noise_random(n, 40); lines; lines--) {
            noise_tokens(n, noise_random(n, noise_random(n, 4) ? 8 : 60));
        }
        break;
    case 3:
        noise_program(n, noise_random(n, 30));
        noise_command(n);
        break;
    case 4:
        for (unsigned lines = noise_random(n, 30); lines; lines--) {
            noise_statement(n);
            noise_bytes(n, noise_random(n, 20) == 0);
            noise_tokens(n, 0);
        }
        break;
    default:
        noise_example(n, 5 + noise_random(n, 40));
        noise_command(n);
        break;
    }
    if (noise_random(n, 3) == 0) {
        noise_line_noise(n, 0);
    }
    if (noise_random(n, 8) == 0) {
        /* The same by tape, with a few keys behind. */
        if (!board_tape(f->board, n->text, n->length)) {
            abort();
        }
        board_reader(f->board, noise_random(n, 2));
        f->queued += n->length;
        type(f, (const uint8_t *)"LOAD\r", 5);
    } else {
        type(f, n->text, n->length);
    }
    clear_paper(f);
    if (noise_random(n, 4)) {
        run(f, 100000 + noise_random(n, 6000000));
    } else {
        /* Sometimes presses keys or the reset button at a random moment. */
        for (unsigned times = 1 + noise_random(n, 5); times; times--) {
            run(f, noise_random(n, 400000));
            if (noise_random(n, 6) == 0) {
                reset_in_the_middle(f);
            } else if (!board_press(f->board, (uint8_t)"\x03\x13\x11\rA1\x15\x7f"[noise_random(n, 8)])) {
                abort();
            }
        }
        run(f, noise_random(n, 3000000));
    }
    break_in(f);
}

static void session(fuzz *f, uint64_t bytes)
{
    static const unsigned sizes[] = { 2, 3, 8, 8, 8, 16, 56 };
    f->noise.state = f->seed * 1000003 + f->session;
    f->board = board_new(f->kind, sizes[noise_random(&f->noise, 7)]);
    if (!f->board) {
        abort();
    }
    f->board->punch_tty = f->punch_tty;
    f->board->paper = on_paper;
    f->board->user = f;
    board_rom(f->board, f->rom, sizeof f->rom);
    if (noise_random(&f->noise, 2)) {
        for (unsigned at = board_ram_start(f->kind); at < I8080_SPACE; at++) {
            i8080_poke(&f->board->cpu, (uint16_t)at, (uint8_t)noise_random(&f->noise, 256));
        }
    }
    i8080_watch(&f->board->cpu, f->session % 4 == 1, 0, BOARD_ROM_SIZE - 1);
    clear_paper(f);
    reset(f);
    to_prompt(f);
    for (f->round = 0; f->round < ROUNDS && f->queued - f->dropped < bytes; f->round++) {
        f->noise.length = 0;
        switch (noise_random(&f->noise, 8)) {
        case 0:
            reset_round(f);
            break;
        case 1:
        case 2:
            harmless_round(f);
            break;
        default:
            any_round(f);
            break;
        }
        if (f->board->cpu.watching) {
            check_watched(f);
        } else {
            check_fetches(f);
        }
        if (unsound(f)) {
            fail(f, "the program is not sound", unsound(f));
        }
        f->rounds++;
    }
    f->dropped += f->board->tape.end - f->board->tape.first;
    f->instructions += f->board->cpu.instructions;
    board_free(f->board);
    f->board = NULL;
}

/* ---- setting up ---- */

static _Noreturn void quit(const char *what)
{
    fprintf(stderr, "fuzz: %s\n", what);
    exit(2);
}

static void read_symbols(places *at, const char *path)
{
    const struct {
        const char *name;
        uint16_t *place;
    } wanted[] = {
        // clang-format off
        { "PEND", &at->pend }, { "VBOT", &at->vbot }, { "VTOP", &at->vtop },
        { "PROG", &at->prog }, { "STKLOW", &at->stklow }, { "STKTOP", &at->stktop },
        // clang-format on
    };
    char line[128], name[64];
    unsigned address, found = 0;
    FILE *file = fopen(path, "r");
    if (!file) {
        quit(path);
    }
    while (fgets(line, sizeof line, file)) {
        if (sscanf(line, "%x %63s", &address, name) != 2) {
            continue;
        }
        for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++) {
            if (!strcmp(name, wanted[i].name)) {
                *wanted[i].place = (uint16_t)address;
                found++;
            }
        }
    }
    fclose(file);
    if (found != sizeof wanted / sizeof *wanted) {
        quit("a symbol is missing");
    }
}

/* A line of the listing with bytes: `1A05   FE                  DB  0FEH ; comment`, a label and colon before the word.
 * A DB of one byte that is the opcode of CPI, MVI B, LXI B or LDA, to skip what is behind it, is an instruction too. */
static void read_listing(fuzz *f, const char *path)
{
    static const char *const restarts[] = { "ERROR", "PUTC", "NEXT", "EXPECT", "CALC", "PEEK", "CHKEND" };
    char line[512];
    unsigned count = 0;
    FILE *file = fopen(path, "r");
    if (!file) {
        quit(path);
    }
    while (fgets(line, sizeof line, file)) {
        char *end, *text = line, word_[16];
        unsigned long at = strtoul(line, &end, 16);
        if (end != line + 4 || strncmp(end, "   ", 3) || end[3] == ' ') {
            continue;
        }
        unsigned long first = strtoul(end, NULL, 16);
        for (text = end + 3; text[0] > ' ' && text[1] > ' ' && text[2] == ' '; text += 3) {
        }
        char *colon = strchr(text, ':'), *comment = strchr(text, ';');
        text = colon && (!comment || colon < comment) ? colon + 1 : text;
        if (sscanf(text, "%15s", word_) != 1 || at >= BOARD_ROM_SIZE) {
            continue;
        }
        bool restart = false;
        const char *operand = strstr(text, word_) + strlen(word_);
        operand += strspn(operand, " ");
        for (size_t i = 0; i < sizeof restarts / sizeof *restarts; i++) {
            size_t length = strlen(restarts[i]);
            restart |= !strncmp(operand, restarts[i], length) && !isalnum((unsigned char)operand[length]);
        }
        bool data = !strcmp(word_, "DB") || !strcmp(word_, "DW") || !strcmp(word_, "DS");
        if (!data
            || (!strcmp(word_, "DB")
                && (restart || first == 0xfe || first == 0x06 || first == 0x01 || first == 0x3a))) {
            f->instruction[at] = true;
            count++;
        }
    }
    fclose(file);
    if (count < 1000) {
        quit("not a listing");
    }
}

/* The command line's options. */
typedef struct {
    const char *rom, *sym, *lst;
    uint64_t bytes;
} wishes;

static bool read_options(int argc, char **argv, wishes *w, fuzz *f)
{
    static const struct option list[] = {
        // clang-format off
        { "rom", required_argument, NULL, 'r' },   { "sym", required_argument, NULL, 'y' },
        { "lst", required_argument, NULL, 'l' },   { "board", required_argument, NULL, 'k' },
        { "punch-tty", no_argument, NULL, 't' },   { "bytes", required_argument, NULL, 'n' },
        { "seed", required_argument, NULL, 's' },  { "session", required_argument, NULL, 'f' },
        { NULL, 0, NULL, 0 },
        // clang-format on
    };
    for (int c; (c = getopt_long(argc, argv, "", list, NULL)) != -1;) {
        switch (c) {
            // clang-format off
        case 'r': w->rom = optarg; break;
        case 'y': w->sym = optarg; break;
        case 'l': w->lst = optarg; break;
        case 'k': f->kind = strcmp(optarg, "8251") ? BOARD_6850 : BOARD_8251; break;
        case 't': f->punch_tty = true; break;
        case 'n': w->bytes = strtoull(optarg, NULL, 10); break;
        case 's': f->seed = strtoull(optarg, NULL, 10); break;
        case 'f': f->session = strtoull(optarg, NULL, 10); break;
        default: return false;
            // clang-format on
        }
    }
    return true;
}

static void print_counts(const fuzz *f, uint64_t first)
{
    printf("%llu bytes typed in %llu sessions, %llu rounds, %llu resets (%llu left a garbled line); %llu million "
           "instructions; stack down to %04X (room from %04X); %.1f s at 2 MHz from ctrl-C to the prompt at most; "
           "program and LIST compared %llu times\n",
           (unsigned long long)(f->queued - f->dropped), (unsigned long long)(f->session - first),
           (unsigned long long)f->rounds, (unsigned long long)f->resets, (unsigned long long)f->renewed,
           (unsigned long long)f->instructions / 1000000, f->lowest, f->at.stklow, (double)f->longest / BOARD_HZ,
           (unsigned long long)f->compared);
}

int main(int argc, char **argv)
{
    static fuzz f;
    wishes w = { .rom = "roms/skg.bin", .sym = "roms/skg.sym", .bytes = 1000000 };
    char error[256];
    f.seed = 1;
    f.lowest = 0xffff;
    if (!read_options(argc, argv, &w, &f)) {
        return 2;
    }
    for (int i = optind; i < argc; i++) {
        if (!noise_read(&f.noise, argv[i])) {
            quit(argv[i]);
        }
    }
    if (!f.noise.line_count) {
        quit("no examples");
    }
    static bool given[BOARD_ROM_SIZE];
    if (image_rom(w.rom, f.rom, given, sizeof f.rom, error, sizeof error)) {
        quit(error);
    }
    read_symbols(&f.at, w.sym);
    if (w.lst) {
        read_listing(&f, w.lst);
    } else {
        memset(f.instruction, true, sizeof f.instruction);
    }
    uint64_t first = f.session;
    while (f.queued - f.dropped < w.bytes) {
        session(&f, w.bytes);
        f.session++;
    }
    print_counts(&f, first);
    noise_free(&f.noise);
    return 0;
}
