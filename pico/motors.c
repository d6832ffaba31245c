/* The drive's port on the Pico's pins. See motors.h. */
#include "motors.h"
#include "chip.h"

enum { IO = 0x40014000, PADS = 0x4001c000, SIO = 0xd0000000, PWM = 0x40050000 };
enum { GPIO_IN = SIO + 0x04, GPIO_OUT = SIO + 0x10, GPIO_TOGGLE = SIO + 0x1c, GPIO_OUTPUTS = SIO + 0x24 };

enum { FIRST_PIN = 2, CUTTING_PIN = 6, STOP_PIN, FEED_IN_PIN, SERVO_PIN };
enum { OUTPUT_PINS = 0x7c };
enum { OF_SIO = 5, OF_PWM = 4 };
enum { INPUT = 1 << 6, PULL_UP = 1 << 3, PULL_DOWN = 1 << 2, SCHMITT = 1 << 1 };

/* The port's bits. */
enum { STEPS_AND_DIRECTIONS = 0x0f, STEPS = 0x05, CUTTING = 0x80, FEED_CLOCK = 0x01, STOP = 0x02 };

/* The servo's pulses: GP9 is channel B of slice 4, which counts microseconds. */
enum { SLICE = PWM + 4 * 0x14, DIVIDE = SLICE + 4, LEVELS = SLICE + 0x0c, TOP = SLICE + 0x10, MHZ = CHIP_HZ / 1000000 };
enum { PERIOD_US = 20000, UP_US = 1250, DOWN_US = 1750, PEN_US = 250000 };

static uint8_t latch;
static uint32_t feed;
/* The square wave: its level, half its period (us, and the rest over 2 * feed), when it turns, the rests summed up. */
static uint32_t level, half, rest, turns_at, over;

static void pin(uint32_t number, uint32_t function, uint32_t pad)
{
    REG(PADS + 4 + number * 4) = pad;
    REG(IO + 4 + number * 8) = function;
}

void motors_start(void)
{
    for (uint32_t number = FIRST_PIN; number <= CUTTING_PIN; number++) {
        pin(number, OF_SIO, INPUT | SCHMITT | 1 << 4); /* 4 mA */
    }
    pin(STOP_PIN, OF_SIO, INPUT | SCHMITT | PULL_UP);
    pin(FEED_IN_PIN, OF_SIO, INPUT | SCHMITT | PULL_DOWN);
    REG(GPIO_OUTPUTS) = OUTPUT_PINS;
    REG(DIVIDE) = MHZ << 4;
    REG(TOP) = PERIOD_US - 1;
    REG(LEVELS) = (uint32_t)UP_US << 16;
    REG(SLICE) = 1;
    pin(SERVO_PIN, OF_PWM, 1 << 4);
}

void motors_feed(uint32_t new_feed)
{
    feed = new_feed;
    if (feed != FEED_FULL && feed != FEED_PIN) {
        half = 1000000 / (2 * feed);
        rest = 1000000 % (2 * feed);
    }
    turns_at = chip_micros();
    over = 0;
}

/* The square wave's level now. Where nobody has asked for 10 ms, it begins anew. */
static uint32_t square_wave(void)
{
    const uint32_t now = chip_micros();
    if ((int32_t)(now - turns_at) > (int32_t)(10000 + half)) {
        turns_at = now;
    }
    while ((int32_t)(now - turns_at) >= 0) {
        level ^= FEED_CLOCK;
        turns_at += half;
        over += rest;
        if (over >= 2 * feed) {
            over -= 2 * feed;
            turns_at++;
        }
    }
    return level;
}

static uint32_t feed_clock(uint32_t pins)
{
    if (feed == FEED_FULL) {
        return latch & STEPS ? 0 : FEED_CLOCK;
    }
    return feed == FEED_PIN ? pins >> FEED_IN_PIN & 1 : square_wave();
}

uint8_t motors_in(void)
{
    uint32_t pins = REG(GPIO_IN);
    return (uint8_t)(feed_clock(pins) | (pins >> STOP_PIN & 1 ? STOP : 0));
}

static void set_pins(uint32_t pins)
{
    REG(GPIO_TOGGLE) = (REG(GPIO_OUT) ^ pins) & OUTPUT_PINS;
}

/* A pulse that comes with a change of the pen waits for it. */
void motors_out(uint8_t value, void (*meanwhile)(void))
{
    const uint32_t pins =
        (uint32_t)(value & STEPS_AND_DIRECTIONS) << FIRST_PIN | (value & CUTTING ? 1u << CUTTING_PIN : 0);
    if ((value ^ latch) & CUTTING) {
        set_pins(pins & ~((uint32_t)STEPS << FIRST_PIN));
        REG(LEVELS) = (uint32_t)(value & CUTTING ? DOWN_US : UP_US) << 16;
        for (uint32_t from = chip_micros(); chip_micros() - from < PEN_US;) {
            meanwhile();
        }
    }
    latch = value;
    set_pins(pins);
}
