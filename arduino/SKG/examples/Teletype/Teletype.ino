/* The machine on the USB line: open the serial monitor at 115200 baud, line ending CR.
 *
 * Type   10 CUT (30,0),(0,30),O   then RUN: the paper has the blocks of a triangle, 0001 B30000B0B30000GXL1 and so on.
 * Serial1, where a board has it, is the punch and the reader: blocks come out there as a tape, LOAD reads from it.
 */
#include <SKG.h>

static uint8_t ram[16 * 1024];
SkgBoard board(Serial, &Serial1, ram, sizeof ram);

void setup()
{
    Serial.begin(115200);
    Serial1.begin(115200);
    while (!Serial && millis() < 5000) {
    }
    board.begin();
}

void loop()
{
    board.run();
}
