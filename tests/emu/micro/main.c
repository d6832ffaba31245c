/* The SKG board on a BBC micro:bit: the small core and the ROM on a Cortex-M0 with 16 KiB of RAM
 *
 *      10H, 11H    teletype: its keys are the debugger's standard input, its paper is standard output
 *      12H, 13H    punch: the file tape.3b; there is no reader
 *
 * All goes through the debugger (semihosting), as qemu has it; nothing of the micro:bit is used but its memory and
 * SysTick. The board waits for nothing, and the operator types with care (board.h). When standard input is at its end and
 * the board waits for a key, it is over: on standard error stand 8080 cycles, instructions and SysTick's ticks meanwhile.
 *
 * NOT IMPLEMENTED: reset of the 6850s, ctrl-C while the board works.
 */
#include "../../../emu/i8080_small.h"

enum { TTY_CONTROL = 0x10, TTY_DATA = 0x11, PUNCH_CONTROL = 0x12, PUNCH_DATA = 0x13, NO_ANSWER = 0xff };
enum { RECEIVED = 0x01, MAY_SEND = 0x02, RTS = 0x60, RTS_HIGH = 0x40 };
enum { ROM_SIZE = 0x2000, RAM_SIZE = 0x2000, SLICE_CYCLES = 20000 };
enum { POLLS_TO_TYPE = 8, POLL_GAP = 500 };

/* The file ROM, in flash. */
__asm__(".section .rodata\nrom: .incbin \"" ROM "\"\n.previous");
extern const uint8_t rom[ROM_SIZE];

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

/* ---- the board ---- */

typedef struct {
    i8080_small cpu;
    uint8_t ram[RAM_SIZE];
    uint32_t keys, paper, punch;
    uint8_t key;
    bool received, holds; /* holds: /RTS is high */
    bool left;            /* the operator has nothing more to type */
    unsigned polls;       /* questions in close succession, since the board last printed */
    uint64_t polled_at;
} board;

static uint8_t tty_status(board *b)
{
    bool close = b->cpu.cycles - b->polled_at <= POLL_GAP && !b->holds;
    b->polls = close ? b->polls + 1 : 0;
    b->polled_at = b->cpu.cycles;
    if (!b->received && b->polls >= POLLS_TO_TYPE) {
        b->received = read_byte(b->keys, &b->key);
        b->left = !b->received;
        if (b->left) {
            i8080_small_stop(&b->cpu);
        }
    }
    return b->received ? RECEIVED | MAY_SEND : MAY_SEND;
}

static uint8_t port_in(void *user, uint8_t port)
{
    board *b = user;
    switch (port) {
    case TTY_CONTROL:
        return tty_status(b);
    case TTY_DATA:
        b->received = false;
        return b->key;
    case PUNCH_CONTROL:
        return MAY_SEND;
    default:
        return NO_ANSWER;
    }
}

static void port_out(void *user, uint8_t port, uint8_t value)
{
    board *b = user;
    if (port == TTY_CONTROL) {
        b->holds = (value & RTS) == RTS_HIGH;
    } else if (port == TTY_DATA) {
        b->polls = 0;
        write_byte(b->paper, value & 0x7f);
    } else if (port == PUNCH_DATA) {
        write_byte(b->punch, value);
    }
}

/* ---- SysTick, which counts down ---- */

static volatile uint32_t *const systick = (uint32_t *)0xe000e010; /* control, reload, current */

enum { SYSTICK_ENABLE = 1, SYSTICK_CPU_CLOCK = 4, SYSTICK_MOST = 0xffffff };

int main(void)
{
    static board b;
    b.keys = open_file(":tt", MODE_READ);
    b.paper = open_file(":tt", MODE_WRITE);
    b.punch = open_file("tape.3b", MODE_WRITE_BINARY);
    i8080_small_init(&b.cpu, port_in, port_out, &b);
    i8080_small_map(&b.cpu, 0, ROM_SIZE - 1, rom, NULL);
    i8080_small_map(&b.cpu, ROM_SIZE, ROM_SIZE + RAM_SIZE - 1, b.ram, b.ram);

    systick[1] = SYSTICK_MOST;
    systick[0] = SYSTICK_ENABLE | SYSTICK_CPU_CLOCK;
    uint64_t ticks = 0;
    while (!b.left) {
        uint32_t before = systick[2];
        i8080_small_run(&b.cpu, SLICE_CYCLES);
        ticks += (before - systick[2]) & SYSTICK_MOST;
    }
    uint32_t errors = open_file(":tt", MODE_APPEND);
    write_number(errors, b.cpu.cycles, ' ');
    write_number(errors, b.cpu.instructions, ' ');
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
