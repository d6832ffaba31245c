/* The SKG board on a BBC micro:bit: the small board and the ROM on a Cortex-M0 with 16 KiB of RAM
 *
 *      10H, 11H    teletype: its keys are the debugger's standard input, its paper is standard output
 *      12H, 13H    punch: the file tape.3b; there is no reader
 *
 * All goes through the debugger (semihosting), as qemu has it; nothing of the micro:bit is used but its memory and
 * SysTick. The board waits for nothing, and the operator types with care (board.h). When standard input is at its end and
 * the board waits for a key, it is over: on standard error stand 8080 cycles, instructions and SysTick's ticks meanwhile.
 *
 * NOT IMPLEMENTED: a reader, ctrl-C while the board works.
 */
#include "../../../emu/small_board.h"

enum { RAM_SIZE = 0x2000, SLICE_CYCLES = 20000 };

/* The file ROM, in flash. */
__asm__(".section .rodata\nrom: .incbin \"" ROM "\"\n.previous");
extern const uint8_t rom[SMALL_BOARD_ROM];

/* Of microbit.ld. */
extern uint32_t stack_top[], data_start[], data_end[], data_load[], bss_start[], bss_end[];

/* ---- the debugger ---- */

enum { SYS_OPEN = 0x01, SYS_WRITE = 0x05, SYS_READ = 0x06, SYS_EXIT = 0x18 };
enum { MODE_READ = 0, MODE_WRITE = 4, MODE_WRITE_BINARY = 5, MODE_APPEND = 8, APPLICATION_EXIT = 0x20026 };

static uint32_t ask_debugger(uint32_t call, const void *arguments)
{
    register uint32_t r0 __asm__("r0") = call;
    register const void *r1 __asm__("r1") = arguments;
    __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
    return r0;
}

static uint32_t open_file(const char *name, uint32_t mode)
{
    uint32_t length = 0;
    while (name[length]) {
        length++;
    }
    const uint32_t arguments[] = { (uint32_t)name, mode, length };
    return ask_debugger(SYS_OPEN, arguments);
}

static void write_byte(uint32_t file, uint8_t byte)
{
    const uint32_t arguments[] = { file, (uint32_t)&byte, 1 };
    ask_debugger(SYS_WRITE, arguments);
}

static bool read_byte(uint32_t file, uint8_t *byte)
{
    const uint32_t arguments[] = { file, (uint32_t)byte, 1 };
    return !ask_debugger(SYS_READ, arguments); /* it tells how many bytes are missing */
}

static void write_number(uint32_t file, uint64_t number, char behind)
{
    char digits[20];
    unsigned count = 0;
    do {
        digits[count++] = (char)('0' + number % 10);
        number /= 10;
    } while (number);
    while (count) {
        write_byte(file, (uint8_t)digits[--count]);
    }
    write_byte(file, (uint8_t)behind);
}

/* ---- the board's lines ---- */

typedef struct {
    small_board board;
    uint8_t ram[RAM_SIZE];
    uint32_t keys, paper, punch;
    bool left; /* the operator has nothing more to type */
} host;

static int key(void *user, bool waits)
{
    host *h = user;
    uint8_t c;
    if (!waits || h->left) {
        return SMALL_BOARD_NONE;
    }
    if (read_byte(h->keys, &c)) {
        return c;
    }
    h->left = true;
    i8080_small_stop(&h->board.cpu);
    return SMALL_BOARD_NONE;
}

static void print(void *user, uint8_t c)
{
    write_byte(((host *)user)->paper, c);
}

static void punch(void *user, uint8_t c)
{
    write_byte(((host *)user)->punch, c);
}

static bool always(void *user)
{
    (void)user;
    return true;
}

static int no_reader(void *user)
{
    (void)user;
    return SMALL_BOARD_NONE;
}

static uint8_t no_drive(void *user)
{
    (void)user;
    return 0;
}

static void no_motors(void *user, uint8_t latch)
{
    (void)user;
    (void)latch;
}

static const small_board_lines lines = { key, always, print, no_reader, always, punch, no_drive, no_motors };

/* ---- SysTick, which counts down ---- */

static volatile uint32_t *const systick = (uint32_t *)0xe000e010; /* control, reload, current */

enum { SYSTICK_ENABLE = 1, SYSTICK_CPU_CLOCK = 4, SYSTICK_MOST = 0xffffff };

int main(void)
{
    static host h;
    h.keys = open_file(":tt", MODE_READ);
    h.paper = open_file(":tt", MODE_WRITE);
    h.punch = open_file("tape.3b", MODE_WRITE_BINARY);
    small_board_init(&h.board, rom, h.ram, RAM_SIZE, &lines, &h);

    systick[1] = SYSTICK_MOST;
    systick[0] = SYSTICK_ENABLE | SYSTICK_CPU_CLOCK;
    uint64_t ticks = 0;
    while (!h.left) {
        uint32_t before = systick[2];
        small_board_run(&h.board, SLICE_CYCLES);
        ticks += (before - systick[2]) & SYSTICK_MOST;
    }
    uint32_t errors = open_file(":tt", MODE_APPEND);
    write_number(errors, h.board.cpu.cycles, ' ');
    write_number(errors, h.board.cpu.instructions, ' ');
    write_number(errors, ticks, '\n');
    ask_debugger(SYS_EXIT, (const void *)APPLICATION_EXIT);
    return 0;
}

/* ---- from reset to main ---- */

static void start(void)
{
    uint32_t *from = data_load;
    for (uint32_t *to = data_start; to < data_end; to++) {
        *to = *from++;
    }
    for (uint32_t *to = bss_start; to < bss_end; to++) {
        *to = 0;
    }
    main();
}

__attribute__((section(".vectors"), used)) static const void *const vectors[] = { stack_top, (const void *)start };
