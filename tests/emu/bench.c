/* bench: the rates of emu/i8080.c, of emu/i8080_small.c and of a plain switch-and-callback core, on one workload in one run
 *
 *      bench image.com [seconds]
 *      bench image.com CORE CYCLES
 *
 * Prints millions of 8080 instructions a second for all, and how often the first has the plain core's. All must print the
 * same text and count the same instructions and cycles, or the exit code is 1. The first and the last are timed several times
 * by turns, the small one twice, and the best time counts: other work of the host can only make a run slower.
 * With a core (ours, small, plain) that one alone runs, for so many cycles, so that a tool may count what the host does.
 */
#include "../../emu/com.h"
#include "../../emu/i8080_small.h"
#include "../../emu/image.h"
#include "plain8080.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

typedef struct {
    uint64_t cycles, instructions;
    double seconds; /* least of all runs; 0: none yet */
    char text[4096];
    size_t length;
} result;

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + (double)t.tv_nsec / 1e9;
}

static void best(result *r, double seconds)
{
    if (r->seconds == 0 || seconds < r->seconds) {
        r->seconds = seconds;
    }
}

/* The cycles after which a core that is to be counted is stopped. */
static uint64_t limit = UINT64_MAX / 2;

static bool run_ours(const uint8_t *program, size_t length, result *r)
{
    i8080 *c = malloc(sizeof *c);
    FILE *out = tmpfile();
    if (!c || !out) {
        return false;
    }
    double start = now();
    com_end end = com_run(c, program, length, limit, out);
    best(r, now() - start);
    r->cycles = c->cycles;
    r->instructions = c->instructions;
    rewind(out);
    r->length = fread(r->text, 1, sizeof r->text, out);
    fclose(out);
    free(c);
    return end == COM_ENDED;
}

/* ---- the other cores, in the same memory and BDOS ---- */

typedef struct {
    plain8080 plain;
    i8080_small small;
    uint8_t memory[65536];
    bool ended;
    result *r;
} machine;

static uint8_t read_memory(void *user, uint16_t address)
{
    return ((machine *)user)->memory[address];
}

static void write_memory(void *user, uint16_t address, uint8_t value)
{
    ((machine *)user)->memory[address] = value;
}

static uint8_t port_in(void *user, uint8_t port)
{
    (void)user;
    (void)port;
    return 0xff;
}

static void print(machine *m, uint8_t c)
{
    if (m->r->length < sizeof m->r->text) {
        m->r->text[m->r->length++] = (char)c;
    }
}

static void bdos(machine *m, uint8_t function, uint16_t de)
{
    if (function == 2) {
        print(m, (uint8_t)de);
    } else {
        for (; m->memory[de] != '$'; de++) {
            print(m, m->memory[de]);
        }
    }
}

static void plain_out(void *user, uint8_t port, uint8_t value)
{
    machine *m = user;
    const uint8_t *r = m->plain.r;
    (void)value;
    if (port == 0 || r[1] == 0) {
        m->ended = true;
    } else {
        bdos(m, r[1], (uint16_t)(r[2] << 8 | r[3]));
    }
}

static void small_out(void *user, uint8_t port, uint8_t value)
{
    machine *m = user;
    uint8_t function = (uint8_t)m->small.bc;
    (void)value;
    if (port == 0 || function == 0) {
        m->ended = true;
        i8080_small_stop(&m->small);
    } else {
        bdos(m, function, m->small.de);
    }
}

static machine *new_machine(const uint8_t *program, size_t length, result *r)
{
    static const uint8_t low[] = { 0xd3, 0, 0, 0, 0, 0xd3, 1, 0xc9 };
    machine *m = calloc(1, sizeof *m);
    if (!m) {
        abort();
    }
    m->r = r;
    r->length = 0;
    memcpy(m->memory, low, sizeof low);
    memcpy(m->memory + COM_START, program, length);
    return m;
}

static bool run_plain(const uint8_t *program, size_t length, result *r)
{
    machine *m = new_machine(program, length, r);
    m->plain = (plain8080){
        // clang-format off
        .read = read_memory, .write = write_memory, .in = port_in, .out = plain_out, .user = m,
        .pc = COM_START, .sp = 0xc8fe,
        // clang-format on
    };
    double start = now();
    while (!m->ended && !m->plain.halted && m->plain.cycles < limit) {
        plain8080_step(&m->plain);
    }
    best(r, now() - start);
    r->cycles = m->plain.cycles;
    r->instructions = m->plain.instructions;
    bool ended = m->ended;
    free(m);
    return ended;
}

static bool run_small(const uint8_t *program, size_t length, result *r)
{
    machine *m = new_machine(program, length, r);
    i8080_small_init(&m->small, port_in, small_out, m);
    i8080_small_map(&m->small, 0, 0xffff, m->memory, m->memory);
    m->small.pc = COM_START;
    m->small.sp = 0xc8fe;
    double start = now();
    i8080_small_run(&m->small, limit);
    best(r, now() - start);
    r->cycles = m->small.cycles;
    r->instructions = m->small.instructions;
    bool ended = m->ended;
    free(m);
    return ended;
}

static bool same(const result *ours, const result *other, const char *name)
{
    if (ours->cycles == other->cycles && ours->instructions == other->instructions && ours->length == other->length
        && !memcmp(ours->text, other->text, ours->length)) {
        return true;
    }
    fprintf(stderr, "bench: the %s does not agree: %llu and %llu instructions, %llu and %llu cycles\n", name,
            (unsigned long long)ours->instructions, (unsigned long long)other->instructions,
            (unsigned long long)ours->cycles, (unsigned long long)other->cycles);
    return false;
}

static void show(const char *name, const result *r)
{
    printf("%-24s %8.1f million instructions/s  (%.3f s)\n", name, (double)r->instructions / r->seconds / 1e6,
           r->seconds);
}

/* One core alone: prints its instructions. */
static int count(const char *core, const uint8_t *program, size_t length)
{
    static const struct {
        const char *name;
        bool (*run)(const uint8_t *program, size_t length, result *r);
    } cores[] = { { "ours", run_ours }, { "small", run_small }, { "plain", run_plain } };
    static result r;
    for (size_t i = 0; i < sizeof cores / sizeof *cores; i++) {
        if (!strcmp(core, cores[i].name)) {
            cores[i].run(program, length, &r);
            printf("%llu\n", (unsigned long long)r.instructions);
            return 0;
        }
    }
    fprintf(stderr, "bench: no core %s\n", core);
    return 2;
}

int main(int argc, char **argv)
{
    static result ours, small, plain;
    char error[256];
    size_t length;
    if (argc < 2) {
        fputs("usage: bench image.com [seconds | CORE CYCLES]\n", stderr);
        return 2;
    }
    uint8_t *program = image_read(argv[1], COM_SIZE, &length, error, sizeof error);
    if (!program) {
        fprintf(stderr, "bench: %s\n", error);
        return 2;
    }
    if (argc > 3) {
        limit = strtoull(argv[3], NULL, 10);
        int exit_code = count(argv[2], program, length);
        free(program);
        return exit_code;
    }
    double seconds = argc > 2 ? atof(argv[2]) : 6;
    double start = now();
    bool sound = true;
    do {
        sound =
            run_ours(program, length, &ours) && run_ours(program, length, &ours) && run_plain(program, length, &plain);
    } while (sound && now() - start < seconds);
    for (int times = 0; sound && times < 2; times++) {
        sound = run_small(program, length, &small);
    }
    free(program);
    if (!sound || !same(&ours, &small, "small core") || !same(&ours, &plain, "plain core")) {
        return 1;
    }
    printf("%s: %llu instructions, %llu cycles\n", argv[1], (unsigned long long)ours.instructions,
           (unsigned long long)ours.cycles);
    show("emu/i8080.c", &ours);
    show("emu/i8080_small.c", &small);
    show("plain callback core", &plain);
    printf("%-24s %8.1f\n", "ratio", plain.seconds / ours.seconds);
    return 0;
}
