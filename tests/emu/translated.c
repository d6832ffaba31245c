/* translated: a translation of a ROM beside the fast loop alone, slice by slice
 *
 *      translated ROM.bin SEED PART...
 *
 * Two boards LOAD and RUN each part; one of them has the translation. After every slice of a random length their
 * registers, cycles, instructions and outputs must agree, and now and then all of memory. Breakpoints in the ROM are
 * set and deleted, and bytes of it written over themselves: each ends the translation, which then begins again. Then the
 * part begins anew some times, and after some slices a byte is changed where both go on. Prints how many slices and
 * instructions were compared, and how many of these the translation has carried out; or the first difference, exit 1.
 */
#include "../../emu/board.h"
#include "../../emu/image.h"
#include "../../emu/translations.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_TAPE = 1 << 20, LONG_SLICE = 60000, SPOILT = 4, SHORT = 100, PART_CYCLES = 400000000 };

typedef struct {
    board *board;
    uint64_t output;            /* hash of all that was printed and punched */
} side;

static uint64_t random_state, slices, instructions, translated, begun, ended;
static i8080_translation counted;
static void (*original)(i8080 *c);

static uint32_t random32(void)
{
    random_state = random_state * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)(random_state >> 32);
}

/* Calls the translation and counts its instructions. */
static void run_counted(i8080 *c)
{
    uint64_t before = c->instructions;
    original(c);
    translated += c->instructions - before;
}

static void take(void *user, uint8_t byte)
{
    side *s = user;
    s->output = (s->output ^ byte) * 1099511628211u;
}

static void begin(side *s)
{
    for (size_t i = 0; translations[i]; i++) {
        original = translations[i]->run;
        counted = *translations[i];
        counted.run = run_counted;
        if (i8080_translate(&s->board->cpu, &counted)) {
            begun++;
            return;
        }
    }
    puts("there is no translation of this ROM");
    exit(EXIT_FAILURE);
}

static bool same(const i8080 *p, const i8080 *q)
{
    return p->a == q->a && p->f == q->f && p->bc == q->bc && p->de == q->de && p->hl == q->hl && p->sp == q->sp
           && p->pc == q->pc && p->inte == q->inte && p->halted == q->halted && p->cycles == q->cycles
           && p->instructions == q->instructions && p->rom_writes == q->rom_writes
           && (random32() % 64 || !memcmp(p->mem, q->mem, sizeof p->mem));
}

/* Runs one slice on both; false when they differ. */
static bool run_both(side *s, uint64_t cycles, board_reason *reason)
{
    *reason = board_run(s[0].board, cycles);
    slices++;
    return board_run(s[1].board, cycles) == *reason && s[0].output == s[1].output
           && same(&s[0].board->cpu, &s[1].board->cpu);
}

/* Sets a breakpoint for one slice, or writes a byte of the ROM over itself, so that the part goes on as it was: both end
 * the translation. */
static bool disturb(side *s)
{
    uint16_t at = (uint16_t)(random32() % BOARD_ROM_SIZE);
    uint8_t byte = i8080_peek(&s[0].board->cpu, at);
    bool is_break = random32() & 1, agree;
    board_reason reason;
    for (int i = 0; i < 2; i++) {
        if (is_break) {
            i8080_break(&s[i].board->cpu, at, true);
        } else {
            i8080_poke(&s[i].board->cpu, at, byte);
        }
    }
    agree = run_both(s, random32() % LONG_SLICE + 1, &reason);
    for (int i = 0; i < 2; i++) {
        i8080_break(&s[i].board->cpu, at, false);
    }
    if (!s[1].board->cpu.translation) {
        ended++;
        begin(&s[1]);
    }
    return agree;
}

/* Writes another byte over the one that comes next, and has both carry it out. It spoils the firmware: the last slice. */
static bool spoil(side *s)
{
    uint16_t pc = s[0].board->cpu.pc;
    uint8_t byte = i8080_peek(&s[0].board->cpu, pc) ^ (uint8_t)(random32() % 255 + 1);
    board_reason reason;
    for (int i = 0; i < 2; i++) {
        i8080_poke(&s[i].board->cpu, pc, byte);
    }
    return run_both(s, LONG_SLICE, &reason);
}

/* Compares both on a part; with `most`, on so many slices and one more in a spoilt firmware. */
static bool compare(const uint8_t *rom, const uint8_t *tape, size_t length, uint64_t most)
{
    static const char *const typed[] = { "", "LOAD\r", "RUN\r" };
    side s[2] = { { NULL, 0 }, { NULL, 0 } };
    for (int i = 0; i < 2; i++) {
        s[i].board = board_new(BOARD_6850, BOARD_RAM_KIB);
        s[i].board->paper = s[i].board->punch = take;
        s[i].board->user = &s[i];
        board_rom(s[i].board, rom, BOARD_ROM_SIZE);
        board_tape(s[i].board, tape, length);
    }
    begin(&s[1]);
    const uint64_t last = slices + most;
    bool agree = true;
    for (size_t k = 0; agree && k < sizeof typed / sizeof *typed; k++) {
        for (int i = 0; i < 2; i++) {
            board_type(s[i].board, (const uint8_t *)typed[k], strlen(typed[k]));
        }
        uint64_t end = s[0].board->cpu.cycles + PART_CYCLES;
        board_reason reason = BOARD_CYCLES;
        while (agree && (!most || slices < last) && (reason == BOARD_CYCLES || reason == BOARD_BREAK)
               && s[0].board->cpu.cycles < end) {
            uint32_t kind = random32() % 16;
            agree = kind ? run_both(s, random32() % (kind < 4 ? 40 : LONG_SLICE) + 1, &reason) : disturb(s);
        }
    }
    agree = agree && (!most || spoil(s));
    if (!agree) {
        const i8080 *p = &s[0].board->cpu, *q = &s[1].board->cpu;
        printf("after slice %llu: PC %04X and %04X, cycle %llu and %llu\n", (unsigned long long)slices, p->pc, q->pc,
               (unsigned long long)p->cycles, (unsigned long long)q->cycles);
    }
    instructions += s[1].board->cpu.instructions;
    board_free(s[0].board);
    board_free(s[1].board);
    return agree;
}

int main(int argc, char **argv)
{
    static uint8_t rom[BOARD_ROM_SIZE];
    static bool given[BOARD_ROM_SIZE];
    char error[256];
    if (argc < 4) {
        fputs("usage: translated ROM.bin SEED PART...\n", stderr);
        return EXIT_FAILURE;
    }
    if (image_rom(argv[1], rom, given, sizeof rom, error, sizeof error)) {
        puts(error);
        return EXIT_FAILURE;
    }
    random_state = strtoull(argv[2], NULL, 0);
    for (int i = 3; i < argc; i++) {
        size_t length;
        uint8_t *tape = image_read(argv[i], MOST_TAPE, &length, error, sizeof error);
        if (!tape) {
            puts(error);
            return EXIT_FAILURE;
        }
        tape[length] = 0x1a; /* ctrl-Z, in place of the NUL: LOAD waits for nothing more */
        bool agree = compare(rom, tape, length + 1, 0);
        for (int k = 0; agree && k < SPOILT; k++) {
            agree = compare(rom, tape, length + 1, random32() % SHORT + 1);
        }
        if (!agree) {
            printf("%s: they differ\n", argv[i]);
            return EXIT_FAILURE;
        }
        free(tape);
    }
    printf("%llu slices, %.1f %% of %llu instructions by a translation, begun %llu times, ended %llu times\n",
           (unsigned long long)slices, 100.0 * (double)translated / (double)instructions,
           (unsigned long long)instructions, (unsigned long long)begun, (unsigned long long)ended);
    return EXIT_SUCCESS;
}
