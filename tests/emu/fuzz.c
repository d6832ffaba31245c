/* fuzz: core, board and file reader under random bytes; made for build/asan/fuzz
 *
 *      fuzz SEED N FILE        N rounds; FILE is overwritten with random .hex and .bin images
 *
 * Nothing is compared: it fails by a sanitizer's report or a crash. Prints counts of its work.
 */
#include "../../emu/com.h"
#include "../../emu/image.h"
#include "../../emu/machine.h"

#include <stdlib.h>
#include <string.h>

static uint64_t random_state;

static uint32_t random32(void)
{
    random_state = random_state * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)(random_state >> 32);
}

static void fill(uint8_t *bytes, size_t length)
{
    for (size_t i = 0; i < length; i++) {
        bytes[i] = (uint8_t)random32();
    }
}

/* Random bytes, in which the board's ports occur often and HLT seldom. */
static void fill_rom(uint8_t *rom)
{
    static const uint8_t io[] = { 0xdb, 0xd3, 0xfb, 0xf3 };
    static const uint8_t ports[] = { 0x10, 0x11, 0x12, 0x13, 0x14 };
    fill(rom, BOARD_ROM_SIZE);
    for (unsigned i = 0; i < BOARD_ROM_SIZE; i++) {
        if (rom[i] == 0x76) {
            rom[i] = io[random32() % sizeof io];
        }
        if (rom[i] == 0xdb || rom[i] == 0xd3) {
            rom[(i + 1) % BOARD_ROM_SIZE] = ports[random32() % sizeof ports];
        }
    }
}

/* Ten calls of one routine anywhere, with random registers and data. */
static void batch(machine *m)
{
    const machine_job job = {
        .registers = { .sp = (uint16_t)random32(), .pc = (uint16_t)random32(), .hl = (uint16_t)random32() },
        // clang-format off
        .max_cycles = 2000, .in_length = 5, .out_length = 7,
        .in_address = (uint16_t)random32(), .out_address = (uint16_t)random32(),
        // clang-format on
    };
    uint8_t in[50], out[70], ends[10];
    uint32_t cycles[10];
    machine_registers registers[10];
    fill(in, sizeof in);
    machine_batch(m, &job, 10, in, out, cycles, ends, registers);
}

/* A board of random kind with a random ROM that uses its ports often, an operator who types, presses and loads. */
static uint64_t fuzz_board(void)
{
    uint8_t rom[BOARD_ROM_SIZE], bytes[512];
    fill_rom(rom);
    machine *m = machine_new(rom, random32() % 4 ? sizeof rom : random32() % sizeof rom, 2 + random32() % 55,
                             random32() % 2, random32() % 2, random32() % 2 ? 9600 : 0);
    if (!m) {
        abort();
    }
    board *b = machine_board(m);
    machine_watch(m, random32() % 2, 0, BOARD_ROM_SIZE - 1);
    for (unsigned run = 0; run < 20; run++) {
        uint8_t code[3];
        fill(bytes, sizeof bytes);
        fill(code, sizeof code);
        board_type(b, bytes, random32() % sizeof bytes);
        board_tape(b, bytes, random32() % sizeof bytes);
        switch (random32() % 8) {
        case 0:
            board_press(b, (uint8_t)random32());
            break;
        case 1:
            machine_interrupt(m, code);
            break;
        case 2:
            machine_break(m, (uint16_t)random32(), random32() % 2);
            break;
        case 3:
            board_forget_typed(b);
            board_reader(b, random32() % 2);
            break;
        case 4:
            machine_poke(m, (uint16_t)random32(), bytes, sizeof bytes);
            break;
        }
        if (board_run(b, random32() % 20000) == BOARD_HALT) {
            board_reset(b);
        }
    }
    batch(m);
    machine_counts counts;
    machine_count(m, &counts);
    machine_free(m);
    return counts.instructions;
}

static uint64_t fuzz_com(FILE *out)
{
    static uint8_t program[COM_SIZE];
    i8080 *c = malloc(sizeof *c);
    if (!c) {
        abort();
    }
    size_t length = random32() % sizeof program;
    fill(program, length);
    com_run(c, program, length, 20000, out);
    rewind(out);
    uint64_t instructions = c->instructions;
    free(c);
    return instructions;
}

/* Writes and reads an Intel hex file that is mostly right, or a binary one. */
static unsigned fuzz_image(const char *path)
{
    static const char letters[] = ":0123456789ABCDEFabcdef \r\nxyz";
    uint8_t rom[BOARD_ROM_SIZE];
    bool given[BOARD_ROM_SIZE];
    char error[256], name[512];
    unsigned wrong = 0;
    for (unsigned round = 0; round < 20; round++) {
        snprintf(name, sizeof name, "%s.%s", path, random32() % 4 ? "hex" : "bin");
        FILE *file = fopen(name, "wb");
        if (!file) {
            abort();
        }
        for (unsigned line = random32() % 20; line; line--) {
            unsigned length = random32() % 40, address = random32() % 0x2100,
                     kind = random32() % 8 ? 0 : random32() % 7;
            unsigned sum = length + (address >> 8) + address + kind;
            fprintf(file, ":%02X%04X%02X", length, address, kind);
            for (unsigned i = 0; i < length; i++) {
                unsigned byte = random32() & 255;
                sum += byte;
                fprintf(file, "%02X", byte);
            }
            fprintf(file, "%02X", -sum & 255);
            if (random32() % 32 == 0) {
                putc(random32() % 16 ? letters[random32() % (sizeof letters - 1)] : 0, file);
            }
            putc('\n', file);
        }
        fputs(random32() % 2 ? ":00000001FF\n" : "", file);
        fclose(file);
        wrong += image_rom(name, rom, given, sizeof rom, error, sizeof error) != 0;
        remove(name);
    }
    return wrong;
}

int main(int argc, char **argv)
{
    uint64_t instructions = 0, wrong = 0;
    if (argc != 4) {
        fputs("usage: fuzz SEED N FILE\n", stderr);
        return 2;
    }
    FILE *out = tmpfile();
    if (!out) {
        return 2;
    }
    unsigned rounds = (unsigned)atoi(argv[2]);
    for (unsigned i = 0; i < rounds; i++) {
        random_state = strtoull(argv[1], NULL, 10) + i;
        instructions += fuzz_board() + fuzz_com(out);
        wrong += fuzz_image(argv[3]);
    }
    fclose(out);
    printf("%u rounds, %llu instructions, %llu of %u images refused\n", rounds, (unsigned long long)instructions,
           (unsigned long long)wrong, rounds * 20);
    return 0;
}
