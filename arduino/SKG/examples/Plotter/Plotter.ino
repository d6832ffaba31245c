/* Two motors with step and direction: the board follows its own tape. DRIVE 1, then RUN; or DRIVE, and a tape on Serial1.
 *
 * SCALE is the steps of a millimetre, divided by 1000: 40 of them are SCALE .04. The pins are examples: change them.
 */
#include <SKG.h>

enum { X_STEP = 2, X_DIR = 3, Y_STEP = 4, Y_DIR = 5, CUTTING = 6, STOP = 7 };
enum { STEPS_A_SECOND = 1000, HALF_US = 500000 / STEPS_A_SECOND };

static uint8_t ram[16 * 1024];
SkgBoard board(Serial, &Serial1, ram, sizeof ram, skg_rom_drive);

/* The direction stands before the pulse. */
static void step(uint8_t latch)
{
    digitalWrite(X_DIR, latch & 0x02 ? HIGH : LOW);
    digitalWrite(Y_DIR, latch & 0x08 ? HIGH : LOW);
    digitalWrite(X_STEP, latch & 0x01 ? HIGH : LOW);
    digitalWrite(Y_STEP, latch & 0x04 ? HIGH : LOW);
    digitalWrite(CUTTING, latch & 0x80 ? HIGH : LOW);
}

/* Bit 0: the feed clock, a step for each rising edge. Bit 1: the chain of stop switches is open. */
static uint8_t clock_and_stop()
{
    return (uint8_t)((micros() / HALF_US & 1) | (digitalRead(STOP) == HIGH ? 2 : 0));
}

void setup()
{
    const uint8_t outputs[] = { X_STEP, X_DIR, Y_STEP, Y_DIR, CUTTING };
    for (uint8_t pin : outputs) {
        pinMode(pin, OUTPUT);
        digitalWrite(pin, LOW);
    }
    pinMode(STOP, INPUT_PULLUP);
    Serial.begin(115200);
    Serial1.begin(115200);
    board.onDrive(step, clock_and_stop);
    board.begin();
}

void loop()
{
    board.run();
}
