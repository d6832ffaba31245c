/* translate: a ROM's program as rows for i8080_translated.c, on standard output.
 *
 *      translate ROM.bin PART...
 *
 * A ROM does not show which of its bytes are instructions. So the board LOADs and RUNs each part: a fetched byte begins
 * an instruction, and so does the byte behind an instruction, or the target of a jump. The bytes behind a CALL or RST
 * count only if a run returned to them: the subroutine may read them as data.
 */
#include "board.h"
#include "image.h"
#include "i8080_words.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    PLACES = BOARD_ROM_SIZE + 3, /* an instruction may end behind the ROM */
    MOST_STEPS = 2000000,       /* instructions, for one command */
    MOST_TAPE = 1 << 20,
    ERROR_SIZE = 256,
    END_OF_TAPE = 0x1a          /* ctrl-Z: LOAD waits for nothing more */
};

#define SECOND(first, second, ...) second
#define CYCLES(row) SECOND(row)
#define LENGTH_OF(op) [0x##op] = LENGTH(OP_##op),
#define CYCLES_OF(op) [0x##op] = CYCLES(OP_##op),
static const uint8_t length[256] = { EVERY_OPCODE(LENGTH_OF) };
static const uint8_t cycles[256] = { EVERY_OPCODE(CYCLES_OF) };

/* An instruction's effect on PC. */
typedef enum {
    GOES_ON,
    JUMPS,
    MAY_JUMP,
    CALLS,
    MAY_CALL,
    RETURNS,
    MAY_RETURN,
    RARE        /* the fast loop's */
} way;

static way way_of(uint8_t op)
{
    switch (op) {
    case 0xc3:
    case 0xcb:
        return JUMPS;
    case 0xcd:
    case 0xdd:
    case 0xed:
    case 0xfd:
        return CALLS;
    case 0xc9:
    case 0xd9:
    case 0xe9:
        return RETURNS;
    case 0xf3:
    case 0xfb:
    case 0x76:
        return RARE;
    }
    switch (op & 0xc7) {
    case 0xc0:
        return MAY_RETURN;
    case 0xc2:
        return MAY_JUMP;
    case 0xc4:
        return MAY_CALL;
    case 0xc7:
        return CALLS;
    }
    return GOES_ON;
}

/* ---- which bytes are instructions ---- */

typedef struct {
    uint8_t rom[PLACES];
    bool fetched[PLACES];       /* in the parts' runs */
    bool known[PLACES];         /* an instruction begins here */
    bool entry[PLACES];         /* ... and a block */
    bool aim[PLACES];           /* a block goes on here, known or not */
} program;

/* The byte or word behind an opcode; of an RST its subroutine; of another one of a single byte 0. */
static unsigned operand_of(const program *p, unsigned at)
{
    uint8_t op = p->rom[at];
    switch (length[op]) {
    case 2:
        return p->rom[at + 1];
    case 3:
        return p->rom[at + 1] | (unsigned)p->rom[at + 2] << 8;
    }
    return way_of(op) == CALLS ? op & 0x38 : 0;
}

static bool leaps(const program *p, unsigned at)
{
    way w = way_of(p->rom[at]);
    return (w == JUMPS || w == MAY_JUMP || w == CALLS || w == MAY_CALL) && operand_of(p, at) < BOARD_ROM_SIZE;
}

/* Marks the instruction at an address and all others that can be found from it. */
static void follow(program *p, unsigned at)
{
    while (at < BOARD_ROM_SIZE && !p->known[at] && way_of(p->rom[at]) != RARE) {
        way w = way_of(p->rom[at]);
        unsigned next = at + length[p->rom[at]];
        p->known[at] = true;
        if (leaps(p, at)) {
            p->entry[operand_of(p, at)] = p->aim[operand_of(p, at)] = true;
            follow(p, operand_of(p, at));
        }
        if (next >= BOARD_ROM_SIZE || w == JUMPS || w == RETURNS || (w == CALLS && !p->fetched[next])) {
            return;
        }
        if (w == CALLS || w == MAY_CALL) {
            p->entry[next] = true;
        }
        at = next;
    }
}

static void find_instructions(program *p)
{
    bool followed[BOARD_ROM_SIZE] = { false };
    for (unsigned at = 0; at < BOARD_ROM_SIZE; at++) {
        if (p->fetched[at]) {
            follow(p, at);
        }
    }
    for (unsigned at = 0; at < BOARD_ROM_SIZE; at++) {
        way w = way_of(p->rom[at]);
        if (p->known[at] && w != JUMPS && w != RETURNS && at + length[p->rom[at]] < BOARD_ROM_SIZE) {
            followed[at + length[p->rom[at]]] = true;
        }
    }
    for (unsigned at = 0; at < BOARD_ROM_SIZE; at++) {
        p->entry[at] = p->known[at] && (p->entry[at] || (p->fetched[at] && !followed[at]));
    }
}

/* ---- rows ---- */

static void print_block(program *p, unsigned begin)
{
    unsigned sum = 0, count = 0, end = begin;
    way last = GOES_ON;
    do {
        sum += cycles[p->rom[end]];
        count++;
        last = way_of(p->rom[end]);
        end += length[p->rom[end]];
    } while (last != JUMPS && last != CALLS && last != RETURNS && end < BOARD_ROM_SIZE && p->known[end]
             && !p->entry[end]);
    printf("BLOCK(%04X, %u, %u)\n", begin, sum, count);
    for (unsigned at = begin; at < end; at += length[p->rom[at]]) {
        uint8_t op = p->rom[at];
        printf("%s(%04X, %u, %02X, %04X, %u, %u)\n", leaps(p, at) ? "LEAP" : "STEP", at, length[op], op,
               operand_of(p, at), sum, count);
        sum -= cycles[op];
        count--;
    }
    if (last != JUMPS && last != CALLS && last != RETURNS) {
        printf("ON_TO(%04X)\n", end);
        p->aim[end] = true;
    }
}

static void print_rows(program *p)
{
    for (unsigned at = 0; at < PLACES; at++) {
        if (p->entry[at]) {
            print_block(p, at);
        } else if (p->aim[at]) {
            printf("ELSEWHERE(%04X)\n", at);
        }
    }
}

/* ---- the parts ---- */

static void give_up(const char *error)
{
    fprintf(stderr, "translate: %s\n", error);
    exit(EXIT_FAILURE);
}

static void ignore(void *user, uint8_t byte)
{
    (void)user;
    (void)byte;
}

/* Types a line, and marks the instructions fetched until the next prompt, or until the limit of steps. */
static void watch(program *p, board *b, const char *line)
{
    board_type(b, (const uint8_t *)line, strlen(line));
    board_reason reason = BOARD_CYCLES;
    for (unsigned i = 0; i < MOST_STEPS && reason == BOARD_CYCLES; i++) {
        unsigned at = b->cpu.pc;
        reason = board_run(b, 1);
        if (at < BOARD_ROM_SIZE) {
            p->fetched[at] = true;
            unsigned to = b->cpu.pc;
            if (to < BOARD_ROM_SIZE && to != at + length[p->rom[at]]) {
                p->entry[to] = true;
            }
        }
    }
}

static void run_part(program *p, const char *name)
{
    char error[ERROR_SIZE];
    size_t size;
    uint8_t *tape = image_read(name, MOST_TAPE, &size, error, sizeof error);
    if (!tape) {
        give_up(error);
    }
    tape[size] = END_OF_TAPE; /* in place of the NUL */
    board *b = board_new(BOARD_6850, BOARD_RAM_MAX_KIB);
    if (!b || !board_tape(b, tape, size + 1)) {
        give_up("no memory");
    }
    free(tape);
    b->paper = b->punch = ignore;
    board_rom(b, p->rom, BOARD_ROM_SIZE);
    watch(p, b, "");
    watch(p, b, "LOAD\r");
    watch(p, b, "RUN\r");
    board_free(b);
}

int main(int argc, char **argv)
{
    static program p;
    if (argc < 3) {
        fputs("usage: translate ROM.bin PART...\n", stderr);
        return EXIT_FAILURE;
    }
    static bool given[BOARD_ROM_SIZE];
    char error[ERROR_SIZE];
    if (image_rom(argv[1], p.rom, given, BOARD_ROM_SIZE, error, sizeof error)) {
        give_up(error);
    }
    for (int i = 2; i < argc; i++) {
        run_part(&p, argv[i]);
    }
    find_instructions(&p);
    print_rows(&p);
    return ferror(stdout) || fflush(stdout) ? EXIT_FAILURE : EXIT_SUCCESS;
}
