/* compare: emu/i8080.c against the plain core, instruction by instruction and stream by stream
 *
 *      compare each                every opcode over all A x operand for arithmetic, and all A x flags x 16 random
 *                                  states for all; once in the fast loop and once in the careful one
 *      compare streams SEED N      N random programs with random slices, interrupts, ROM and open bus
 *      compare small each          the same of the small core, with fewer states: its words are the large one's, so of
 *      compare small streams ...   arithmetic the immediate opcodes do, and a state for all A x flags
 *
 * Ports stop the run and raise interrupts. Registers, flags, cycles, instructions, interrupt state, ports and all of memory must agree. Prints what was compared
 * and exits 0, or prints the first difference and exits 1.
 */
#include "../../emu/i8080.h"
#include "../../emu/i8080_small.h"
#include "plain8080.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    uint8_t kind[256];          /* of each page: i8080_kind */
    uint8_t memory[65536];
    uint16_t written[2];        /* addresses of the last instruction's writes */
    unsigned writes;
    uint64_t ports, our_ports;  /* hash of everything that went through the ports */
    bool stop, irq;             /* the plain core's: a port has said so */
    uint8_t irq_code;
    plain8080 plain;
    i8080 core;
    i8080_small small;          /* if it is compared, `core` keeps its memory, and its registers between runs */
    bool is_small;
} pair;

static uint64_t random_state;

static uint32_t random32(void)
{
    random_state = random_state * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)(random_state >> 32);
}

static uint64_t mixed(uint64_t hash, unsigned a, unsigned b)
{
    return (hash ^ (a << 8 | b)) * 1099511628211u;
}

static uint8_t read_memory(void *user, uint16_t address)
{
    return ((pair *)user)->memory[address];
}

static void write_memory(void *user, uint16_t address, uint8_t value)
{
    pair *p = user;
    if (p->kind[address >> 8] == I8080_RAM) {
        p->memory[address] = value;
    }
    p->written[p->writes++ & 1] = address;
}

static const uint8_t bus_opcodes[] = { 0xc7, 0xcf, 0xd7, 0xff, 0x00, 0x23, 0x80, 0xe5, 0xfb, 0xf3, 0x76 };

static void interrupt(pair *p, uint8_t opcode)
{
    const uint8_t code[3] = { opcode, 0, 0 };
    if (p->is_small) {
        i8080_small_interrupt(&p->small, code);
    } else {
        i8080_interrupt(&p->core, code);
    }
}

/* What a port gives, and whether it stops the run or raises an interrupt, depends on what went before, so that an access
 * too many or too few shows. */
static void plain_port(pair *p, uint8_t port, unsigned value)
{
    p->ports = mixed(p->ports, port, value);
    if (!(p->ports >> 40 & 7)) {
        p->stop = true;
    }
    if (!(p->ports >> 44 & 7)) {
        p->irq = true;
        p->irq_code = bus_opcodes[(p->ports >> 48) % sizeof bus_opcodes];
    }
}

static void core_port(pair *p, uint8_t port, unsigned value)
{
    p->our_ports = mixed(p->our_ports, port, value);
    if (!(p->our_ports >> 40 & 7)) {
        if (p->is_small) {
            i8080_small_stop(&p->small);
        } else {
            i8080_stop(&p->core);
        }
    }
    if (!(p->our_ports >> 44 & 7)) {
        interrupt(p, bus_opcodes[(p->our_ports >> 48) % sizeof bus_opcodes]);
    }
}

static uint8_t plain_in(void *user, uint8_t port)
{
    pair *p = user;
    plain_port(p, port, 256);
    return (uint8_t)(p->ports >> 32);
}

static void plain_out(void *user, uint8_t port, uint8_t value)
{
    plain_port(user, port, value);
}

static uint8_t core_in(void *user, uint8_t port)
{
    pair *p = user;
    core_port(p, port, 256);
    return (uint8_t)(p->our_ports >> 32);
}

static void core_out(void *user, uint8_t port, uint8_t value)
{
    core_port(user, port, value);
}

/* Runs the core; with the small one `core` has its registers before and after. */
static i8080_reason run_core(pair *p, uint64_t cycles)
{
    i8080 *c = &p->core;
    i8080_small *s = &p->small;
    if (!p->is_small) {
        return i8080_run(c, cycles);
    }
#define COPY(to, from)                                                                                              \
    ((to)->a = (from)->a, (to)->f = (from)->f, (to)->bc = (from)->bc, (to)->de = (from)->de, (to)->hl = (from)->hl, \
     (to)->sp = (from)->sp, (to)->pc = (from)->pc, (to)->inte = (from)->inte, (to)->halted = (from)->halted)
    COPY(s, c);
    i8080_reason reason = i8080_small_run(s, cycles);
    COPY(c, s);
    c->cycles = s->cycles;
    c->instructions = s->instructions;
    return reason;
}

/* The same of the plain core. */
static i8080_reason run_plain(pair *p, uint64_t cycles)
{
    plain8080 *c = &p->plain;
    for (uint64_t end = c->cycles + cycles;;) {
        if (p->stop) {
            p->stop = false;
            return I8080_STOPPED;
        }
        if (c->cycles >= end) {
            return I8080_CYCLES;
        }
        if (p->irq && plain8080_interrupt(c, p->irq_code)) {
            p->irq = false;
        } else if (c->halted) {
            return I8080_HALTED;
        } else {
            plain8080_step(c);
        }
    }
}

static uint16_t pair_of(const plain8080 *c, unsigned high)
{
    return (uint16_t)(c->r[high] << 8 | c->r[high + 1]);
}

static void set_both(pair *p, uint8_t a, uint8_t flags, uint16_t bc, uint16_t de, uint16_t hl, uint16_t sp, uint16_t pc)
{
    plain8080 *c = &p->plain;
    const uint8_t r[8] = { bc >> 8, (uint8_t)bc, de >> 8, (uint8_t)de, hl >> 8, (uint8_t)hl, 0, a };
    memcpy(c->r, r, sizeof r);
    plain8080_set_flags(c, flags);
    c->sp = sp;
    c->pc = pc;
    p->core.a = a;
    p->core.f = flags;
    p->core.bc = bc;
    p->core.de = de;
    p->core.hl = hl;
    p->core.sp = sp;
    p->core.pc = pc;
}

static void poke_both(pair *p, uint16_t address, uint8_t value)
{
    if (p->kind[address >> 8] != I8080_OPEN) {
        p->memory[address] = value;
        i8080_poke(&p->core, address, value);
    }
}

static void show(const pair *p, const char *what)
{
    const plain8080 *c = &p->plain;
    const i8080 *k = &p->core;
    printf("different after %s\n", what);
    printf("core  A %02X F %02X BC %04X DE %04X HL %04X SP %04X PC %04X inte %d halted %d cycles %llu instr %llu\n",
           k->a, k->f, k->bc, k->de, k->hl, k->sp, k->pc, k->inte, k->halted, (unsigned long long)k->cycles,
           (unsigned long long)k->instructions);
    printf("plain A %02X F %02X BC %04X DE %04X HL %04X SP %04X PC %04X inte %d halted %d cycles %llu instr %llu\n",
           c->r[7], plain8080_flags(c), pair_of(c, 0), pair_of(c, 2), pair_of(c, 4), c->sp, c->pc, c->inte, c->halted,
           (unsigned long long)c->cycles, (unsigned long long)c->instructions);
    for (unsigned i = 0; i < 65536; i++) {
        if (p->memory[i] != i8080_peek(k, (uint16_t)i)) {
            printf("memory %04X: core %02X, plain %02X\n", i, i8080_peek(k, (uint16_t)i), p->memory[i]);
            break;
        }
    }
}

static bool same(const pair *p)
{
    const plain8080 *c = &p->plain;
    const i8080 *k = &p->core;
    for (unsigned i = 0; i < 2 && i < p->writes; i++) {
        if (p->memory[p->written[i]] != i8080_peek(k, p->written[i])) {
            return false;
        }
    }
    return k->a == c->r[7] && k->f == plain8080_flags(c) && k->bc == pair_of(c, 0) && k->de == pair_of(c, 2)
           && k->hl == pair_of(c, 4) && k->sp == c->sp && k->pc == c->pc && k->inte == c->inte && k->halted == c->halted
           && k->cycles == c->cycles && k->instructions == c->instructions && p->ports == p->our_ports;
}

static bool same_memory(const pair *p)
{
    return !memcmp(p->memory, p->core.mem, sizeof p->memory);
}

/* Runs both, which must end alike. */
static bool run_both(pair *p, uint64_t cycles)
{
    p->writes = 0;
    return run_core(p, cycles) == run_plain(p, cycles) && same(p);
}

/* Both empty, both with the same random memory. */
static pair *new_pair(bool is_small)
{
    pair *p = calloc(1, sizeof *p);
    if (!p) {
        abort();
    }
    p->is_small = is_small;
    i8080_init(&p->core, core_in, core_out, p);
    i8080_small_init(&p->small, core_in, core_out, p);
    i8080_small_map(&p->small, 0, 0xffff, p->core.mem, p->core.mem);
    p->plain = (plain8080){
        // clang-format off
        .read = read_memory, .write = write_memory, .in = plain_in, .out = plain_out, .user = p,
        // clang-format on
    };
    for (unsigned i = 0; i < 65536; i++) {
        poke_both(p, (uint16_t)i, (uint8_t)random32());
    }
    return p;
}

/* ---- every opcode ---- */

static bool one(pair *p, unsigned opcode)
{
    p->core.halted = p->plain.halted = false;
    if (run_both(p, 1)) {
        return true;
    }
    char what[32];
    snprintf(what, sizeof what, "opcode %02X", opcode);
    show(p, what);
    return false;
}

/* The arithmetic opcodes over all A, all operands, and both states of CY, AC and the rest. */
static bool each_arithmetic(pair *p, unsigned opcode, uint64_t *count)
{
    enum { AT = 0x4000, OPERAND = 0x5000 };
    static const uint8_t flags[] = { 0x02, 0x03, 0x12, 0x13, 0xc6, 0xc7, 0xd6, 0xd7 };
    poke_both(p, AT, (uint8_t)opcode);
    for (unsigned operand = 0; operand < 256; operand++) {
        uint16_t twice = (uint16_t)(operand << 8 | operand);
        unsigned r = opcode & 7;
        bool immediate = opcode >= 0xc0;
        uint16_t hl = !immediate && r == 6 ? OPERAND : twice;
        poke_both(p, AT + 1, (uint8_t)operand);
        poke_both(p, OPERAND, (uint8_t)operand);
        for (unsigned a = 0; a < 256; a++) {
            for (unsigned i = 0; i < sizeof flags; i++) {
                set_both(p, (uint8_t)a, flags[i], twice, twice, hl, 0x6000, AT);
                if (!one(p, opcode)) {
                    return false;
                }
                ++*count;
            }
        }
    }
    return true;
}

/* Any opcode over all A and all flags in so many random states, anywhere in memory. */
static bool each_anywhere(pair *p, unsigned opcode, unsigned states, uint64_t *count)
{
    for (unsigned i = 0; i < 256 * 32 * states; i++) {
        unsigned set = i >> 8 & 31;
        uint8_t flags = (uint8_t)((set & 0x18) << 3 | (set & 4) << 2 | (set & 2) << 1 | 2 | (set & 1));
        uint32_t x = random32(), y = random32(), z = random32();
        uint16_t pc = (uint16_t)z;
        poke_both(p, pc, (uint8_t)opcode);
        if (!(z >> 16 & 15)) { /* the operand is its own address */
            poke_both(p, (uint16_t)(pc + 1), (uint8_t)(pc + 1));
            poke_both(p, (uint16_t)(pc + 2), (uint8_t)((pc + 1) >> 8));
        }
        set_both(p, (uint8_t)i, flags, (uint16_t)x, (uint16_t)(x >> 16), (uint16_t)y, (uint16_t)(y >> 16), pc);
        if (!one(p, opcode)) {
            return false;
        }
        ++*count;
    }
    return true;
}

static int compare_each(bool is_small)
{
    uint64_t count = 0;
    for (int careful = 0; careful < (is_small ? 1 : 2); careful++) {
        pair *p = new_pair(is_small);
        i8080_watch(&p->core, careful, 0, 0xffff);
        for (unsigned opcode = 0; opcode < 256; opcode++) {
            bool arithmetic = ((opcode & 0xc0) == 0x80 && !is_small) || (opcode & 0xc7) == 0xc6;
            if ((arithmetic && !each_arithmetic(p, opcode, &count))
                || !each_anywhere(p, opcode, is_small ? 1 : 16, &count)) {
                return 1;
            }
            if (!same_memory(p)) {
                show(p, "an opcode's states");
                return 1;
            }
        }
        free(p);
    }
    printf("%llu instructions compared\n", (unsigned long long)count);
    return 0;
}

/* ---- random programs ---- */

/* Maps pages at random: all RAM, or a ROM below and nothing at the top. */
static void map_at_random(pair *p)
{
    if (random32() & 1) {
        return;
    }
    for (unsigned page = 0; page < 256; page++) {
        i8080_kind kind = page < 0x20 ? I8080_ROM : page >= 0xe0 ? I8080_OPEN : I8080_RAM;
        p->kind[page] = (uint8_t)kind;
        i8080_map(&p->core, (uint16_t)(page << 8), (uint16_t)(page << 8 | 255), kind);
        if (kind == I8080_OPEN) {
            memset(p->memory + (page << 8), 0xff, 256);
        }
    }
    i8080_small_map(&p->small, 0, 0x1fff, p->core.mem, NULL);
    i8080_small_map(&p->small, 0xe000, 0xffff, NULL, NULL);
}

/* Some programs are noise; most hold many instructions that go on to the next, so that they get somewhere. */
static void write_program(pair *p)
{
    static const uint8_t steady[] = {
        0x7e, 0x77, 0x23, 0x2b, 0x13, 0x1a, 0x12, 0x05, 0x0d, 0x3d, 0x78, 0x47, 0x4f, 0x79, 0x1f, 0x17, 0x29, 0x19,
        0xb7, 0xaf, 0xa6, 0xc5, 0xd5, 0xe5, 0xf5, 0xc1, 0xd1, 0xe1, 0xf1, 0xeb, 0xe3, 0xbe, 0x8e, 0x27, 0x34, 0x35,
    };
    unsigned noise = random32() % 4;
    for (unsigned i = 0; i < 65536; i++) {
        uint32_t x = random32();
        bool keep = noise == 0 || (x >> 16 & 3) < noise;
        poke_both(p, (uint16_t)i, keep ? (uint8_t)x : steady[(x & 0xffff) % sizeof steady]);
    }
}

/* Raises an interrupt, also where it must not be taken or only after the next instruction. */
static bool interrupt_both(pair *p)
{
    p->irq = true;
    p->irq_code = bus_opcodes[random32() % sizeof bus_opcodes];
    interrupt(p, p->irq_code);
    for (int tries = 0; tries < 2 && p->irq; tries++) {
        if (!run_both(p, 1)) {
            return false;
        }
    }
    p->irq = false;
    i8080_interrupt_clear(&p->core);
    i8080_small_interrupt_clear(&p->small);
    return true;
}

static bool stream(pair *p, uint64_t *instructions)
{
    map_at_random(p);
    write_program(p);
    uint32_t x = random32(), y = random32(), z = random32();
    set_both(p, (uint8_t)z, (uint8_t)((z >> 8 & 0xd5) | 2), (uint16_t)x, (uint16_t)(x >> 16), (uint16_t)y,
             (uint16_t)(y >> 16), random32() % 8 ? (uint16_t)(z >> 16) : 0xfff0);
    i8080_watch(&p->core, random32() % 8 == 0, 0, 0xffff);
    for (unsigned slices = 0; slices < 40; slices++) {
        uint64_t cycles = random32() % (random32() & 1 ? 30 : 3000);
        if (!run_both(p, cycles) || (random32() % 2 && !interrupt_both(p))) {
            return false;
        }
        if (p->plain.halted) {
            p->plain.halted = p->core.halted = false;
        }
    }
    *instructions += p->plain.instructions;
    return same_memory(p);
}

static int compare_streams(bool is_small, uint64_t seed, unsigned count)
{
    uint64_t instructions = 0;
    for (unsigned i = 0; i < count; i++) {
        random_state = seed + i;
        random32();
        pair *p = new_pair(is_small);
        if (!stream(p, &instructions)) {
            char what[64];
            snprintf(what, sizeof what, "stream with seed %llu", (unsigned long long)(seed + i));
            show(p, what);
            return 1;
        }
        free(p);
    }
    printf("%u streams, %llu instructions compared\n", count, (unsigned long long)instructions);
    return 0;
}

int main(int argc, char **argv)
{
    bool is_small = argc > 1 && !strcmp(argv[1], "small");
    argc -= is_small;
    argv += is_small;
    if (argc == 2 && !strcmp(argv[1], "each")) {
        return compare_each(is_small);
    }
    if (argc == 4 && !strcmp(argv[1], "streams")) {
        return compare_streams(is_small, strtoull(argv[2], NULL, 10), (unsigned)atoi(argv[3]));
    }
    fputs("usage: compare [small] each | compare [small] streams SEED N\n", stderr);
    return 2;
}
