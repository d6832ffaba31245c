/* bench: the rate of emu/i8080.c beside that of a plain switch-and-callback core, on one workload in one run
 *
 *      bench image.com [seconds]
 *
 * Prints millions of 8080 instructions a second for both and their ratio. Both must print the same text and count the
 * same instructions and cycles, or the exit code is 1. Each is timed several times by turns, and its best time counts:
 * other work of the host can only make a run slower.
 */
#include "../../emu/com.h"
#include "../../emu/image.h"
#include "plain8080.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

typedef struct {
    uint64_t cycles, instructions;
    double seconds;             /* least of all runs; 0: none yet */
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

static bool run_ours(const uint8_t *program, size_t length, result *r)
{
    i8080 *c = malloc(sizeof *c);
    FILE *out = tmpfile();
    if (!c || !out) {
        return false;
    }
    double start = now();
    com_end end = com_run(c, program, length, UINT64_MAX / 2, out);
    best(r, now() - start);
    r->cycles = c->cycles;
    r->instructions = c->instructions;
    rewind(out);
    r->length = fread(r->text, 1, sizeof r->text, out);
    fclose(out);
    free(c);
    return end == COM_ENDED;
}

/* ---- the plain core, with the same memory and BDOS ---- */

typedef struct {
    plain8080 cpu;
    uint8_t memory[65536];
    bool ended;
    result *r;
} plain_machine;

static uint8_t read_memory(void *user, uint16_t address)
{
    return ((plain_machine *)user)->memory[address];
}

static void write_memory(void *user, uint16_t address, uint8_t value)
{
    ((plain_machine *)user)->memory[address] = value;
}

static uint8_t port_in(void *user, uint8_t port)
{
    (void)user;
    (void)port;
    return 0xff;
}

static void print(plain_machine *m, uint8_t c)
{
    if (m->r->length < sizeof m->r->text) {
        m->r->text[m->r->length++] = (char)c;
    }
}

static void port_out(void *user, uint8_t port, uint8_t value)
{
    plain_machine *m = user;
    const uint8_t *r = m->cpu.r;
    (void)value;
    if (port == 0 || r[1] == 0) {
        m->ended = true;
    } else if (r[1] == 2) {
        print(m, r[3]);
    } else {
        for (uint16_t at = (uint16_t)(r[2] << 8 | r[3]); m->memory[at] != '$'; at++) {
            print(m, m->memory[at]);
        }
    }
}

static bool run_plain(const uint8_t *program, size_t length, result *r)
{
    static const uint8_t low[] = { 0xd3, 0, 0, 0, 0, 0xd3, 1, 0xc9 };
    plain_machine *m = calloc(1, sizeof *m);
    if (!m) {
        return false;
    }
    m->r = r;
    m->cpu = (plain8080){
        // clang-format off
        .read = read_memory, .write = write_memory, .in = port_in, .out = port_out, .user = m,
        .pc = COM_START, .sp = 0xc8fe,
        // clang-format on
    };
    memcpy(m->memory, low, sizeof low);
    memcpy(m->memory + COM_START, program, length);
    r->length = 0;
    double start = now();
    while (!m->ended && !m->cpu.halted) {
        plain8080_step(&m->cpu);
    }
    best(r, now() - start);
    r->cycles = m->cpu.cycles;
    r->instructions = m->cpu.instructions;
    bool ended = m->ended;
    free(m);
    return ended;
}

static void show(const char *name, const result *r)
{
    printf("%-24s %8.1f million instructions/s  (%.3f s)\n", name, (double)r->instructions / r->seconds / 1e6,
           r->seconds);
}

int main(int argc, char **argv)
{
    static result ours, plain;
    char error[256];
    size_t length;
    if (argc < 2) {
        fputs("usage: bench image.com [seconds]\n", stderr);
        return 2;
    }
    uint8_t *program = image_read(argv[1], COM_SIZE, &length, error, sizeof error);
    if (!program) {
        fprintf(stderr, "bench: %s\n", error);
        return 2;
    }
    double seconds = argc > 2 ? atof(argv[2]) : 6;
    double start = now();
    bool sound = true;
    do {
        sound =
            run_ours(program, length, &ours) && run_ours(program, length, &ours) && run_plain(program, length, &plain);
    } while (sound && now() - start < seconds);
    free(program);
    if (!sound || ours.cycles != plain.cycles || ours.instructions != plain.instructions || ours.length != plain.length
        || memcmp(ours.text, plain.text, ours.length)) {
        fprintf(stderr, "bench: the two cores do not agree: %llu and %llu instructions, %llu and %llu cycles\n",
                (unsigned long long)ours.instructions, (unsigned long long)plain.instructions,
                (unsigned long long)ours.cycles, (unsigned long long)plain.cycles);
        return 1;
    }
    printf("%s: %llu instructions, %llu cycles\n", argv[1], (unsigned long long)ours.instructions,
           (unsigned long long)ours.cycles);
    show("emu/i8080.c", &ours);
    show("plain callback core", &plain);
    printf("%-24s %8.1f\n", "ratio", plain.seconds / ours.seconds);
    return 0;
}
