/* The RP2040 from reset to main, its clocks and its time. See chip.h.
 *
 * The boot ROM loads the flash's first 256 bytes (boot2.S), which let the flash be read as memory and go to start(). All
 * code and all data that change are copied into RAM: the flash is slow, and cannot be read while it is written.
 */
#include "chip.h"

enum {
    RESETS = 0x4000c000,
    CLOCKS = 0x40008000,
    XOSC = 0x40024000,
    PLL_SYS = 0x40028000,
    PLL_USB = 0x4002c000,
    WATCHDOG = 0x40058000,
    TIMER = 0x40054000,
    IO_QSPI = 0x40018000,
    SIO = 0xd0000000
};

/* Resets: their bits, and RESET_DONE. */
enum {
    RESET_DONE = RESETS + 8,
    IO_BANK0 = 1 << 5,
    PADS_BANK0 = 1 << 8,
    PLLS = 1 << 12 | 1 << 13,
    PWM = 1 << 14,
    TIMER_BIT = 1 << 21,
    USBCTRL = 1 << 24,
    NEEDED = IO_BANK0 | PADS_BANK0 | PWM | TIMER_BIT | USBCTRL
};

/* Clocks: the glitchless ones have SELECTED; ENABLE of the others. */
enum {
    REF_CTRL = CLOCKS + 0x30,
    REF_SELECTED = CLOCKS + 0x38,
    SYS_CTRL = CLOCKS + 0x3c,
    SYS_SELECTED = CLOCKS + 0x44,
    USB_CTRL = CLOCKS + 0x54,
    FROM_XOSC = 2,
    FROM_AUX = 1,
    ENABLE = 1 << 11
};

enum {
    XOSC_1_TO_15_MHZ = 0xaa0,
    XOSC_ENABLE = 0xfab000,
    XOSC_STARTUP = XOSC + 12,
    STARTUP_8_MS = 47 * 8, /* times 256 periods of 12 MHz; slow crystals take longer than the 1 ms of the data sheet */
    STABLE = 1 << 31
};

enum {
    PLL_POWER = 4,
    PLL_MULTIPLY = 8,
    PLL_DIVIDE = 12,
    PLL_POWER_DOWN = 1 << 0,
    VCO_DOWN = 1 << 5,
    DIVIDER_DOWN = 1 << 3
};

enum { TICK = WATCHDOG + 0x2c, TICK_ENABLE = 1 << 9, XOSC_MHZ = 12, TIME_LOW = TIMER + 0x28 };

/* A PLL at 12 MHz times `multiply`, divided by both. */
static void start_pll(uint32_t pll, uint32_t multiply, uint32_t divide1, uint32_t divide2)
{
    REG(pll) = 1;
    REG(pll + PLL_MULTIPLY) = multiply;
    CLEAR(pll + PLL_POWER) = PLL_POWER_DOWN | VCO_DOWN;
    while (!(REG(pll) & (uint32_t)STABLE)) {
    }
    REG(pll + PLL_DIVIDE) = divide1 << 16 | divide2 << 12;
    CLEAR(pll + PLL_POWER) = DIVIDER_DOWN;
}

static void reset(uint32_t blocks)
{
    SET(RESETS) = blocks;
    CLEAR(RESETS) = blocks;
    while (~REG(RESET_DONE) & blocks) {
    }
}

void chip_start(void)
{
    REG(XOSC) = XOSC_1_TO_15_MHZ;
    REG(XOSC_STARTUP) = STARTUP_8_MS;
    SET(XOSC) = XOSC_ENABLE;
    while (!(REG(XOSC + 4) & (uint32_t)STABLE)) {
    }
    CLEAR(SYS_CTRL) = FROM_AUX; /* off the PLL, where a debugger has restarted a running chip */
    while (REG(SYS_SELECTED) != 1) {
    }
    REG(REF_CTRL) = FROM_XOSC;
    while (REG(REF_SELECTED) != 1 << FROM_XOSC) {
    }
    reset(PLLS);
    start_pll(PLL_SYS, 125, 6, 2); /* 125 MHz */
    start_pll(PLL_USB, 100, 5, 5); /* 48 MHz */
    REG(SYS_CTRL) = 0;
    SET(SYS_CTRL) = FROM_AUX;
    while (REG(SYS_SELECTED) != 1 << FROM_AUX) {
    }
    REG(USB_CTRL) = ENABLE;
    reset(NEEDED);
    REG(TICK) = XOSC_MHZ | TICK_ENABLE; /* the timer counts microseconds */
}

uint32_t chip_micros(void)
{
    return REG(TIME_LOW);
}

/* BOOTSEL pulls the flash's select line down, behind a resistor: the line is let go for a moment, and looked at. */
bool chip_bootsel(void)
{
    enum { SS_CTRL = IO_QSPI + 0x0c, OVERRIDE = 3 << 12, DISABLED = 2 << 12, GPIO_HI_IN = SIO + 8, SS = 1 << 1 };
    CLEAR(SS_CTRL) = OVERRIDE;
    SET(SS_CTRL) = DISABLED;
    for (uint32_t from = chip_micros(); chip_micros() - from < 10;) {
    }
    bool pressed = !(REG(GPIO_HI_IN) & SS);
    CLEAR(SS_CTRL) = OVERRIDE;
    return pressed;
}

/* ---- from reset to main ---- */

/* Of pico.ld. */
extern uint32_t stack_top[], image_start[], image_end[], image_load[], bss_start[], bss_end[];
int main(void);

__attribute__((section(".boot"), used, noreturn)) void start(void)
{
    uint32_t *from = image_load;
    for (uint32_t *to = image_start; to < image_end; to++) {
        *to = *from++;
    }
    for (uint32_t *to = bss_start; to < bss_end; to++) {
        *to = 0;
    }
    ((void (*)(void))((uintptr_t)main | 1))(); /* far away, and Thumb */
    for (;;) {
    }
}

/* A fault: no pulse, nothing cuts, and the chip begins anew, but for its oscillators. */
__attribute__((section(".boot"), used, noreturn)) void fault(void)
{
    enum { OUT_CLEAR = SIO + 0x18, MOTOR_PINS = 0x7c, PSM_WDSEL = 0x40010008, ALL_BUT_OSCILLATORS = 0x1fffc };
    REG(OUT_CLEAR) = MOTOR_PINS;
    REG(PSM_WDSEL) = ALL_BUT_OSCILLATORS;
    SET(WATCHDOG) = 1u << 31; /* TRIGGER */
    for (;;) {
    }
}

/* Stack, reset, NMI, hard fault; no interrupt is ever enabled. */
__attribute__((section(".vectors"), used)) static const void *const vectors[] = { stack_top, start, fault, fault };

/* Functions that the compiler calls. (Else it would make calls of these loops to themselves.) */
__attribute__((optimize("no-tree-loop-distribute-patterns"))) void *memcpy(void *to, const void *from, __SIZE_TYPE__ n)
{
    uint8_t *t = to;
    for (const uint8_t *f = from; n--;) {
        *t++ = *f++;
    }
    return to;
}

__attribute__((optimize("no-tree-loop-distribute-patterns"))) void *memset(void *to, int value, __SIZE_TYPE__ n)
{
    for (uint8_t *t = to; n--;) {
        *t++ = (uint8_t)value;
    }
    return to;
}
