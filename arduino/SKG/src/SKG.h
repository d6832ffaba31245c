/* The SKG board for an Arduino: two streams, two functions, the ROM of 1983's numerical control
 *
 *      uint8_t ram[16 * 1024];
 *      SkgBoard board(Serial, &Serial1, ram, sizeof ram);      teletype; punch and reader, or nullptr
 *
 *      void setup() { Serial.begin(115200); board.begin(); }
 *      void loop() { board.run(); }
 *
 * A terminal on the teletype's stream shows `SKG`, the free bytes and `>`. Lines may be pasted: a key is handed over when
 * the board waits for it; ctrl-C, ctrl-S and ctrl-Q pass all others, and ctrl-C drops what was typed ahead.
 *
 * NOT IMPLEMENTED: keeping the program over power off; AVR.
 */
#ifndef SKG_H
#define SKG_H

#include <Arduino.h>

#include "skg_rom.h"
#include "small_board.h"

class SkgBoard
{
  public:
    /* `ram`: 2 KiB or more, a multiple of 1,024 bytes, 56 KiB at most. `rom`: skg_rom, or skg_rom_drive, which steps motors. */
    SkgBoard(Stream &teletype, Stream *tape, uint8_t *ram, size_t ram_size, const uint8_t *rom = skg_rom);

    /* The drive's port (docs/spec/drive.md). `out` gets each value of the latch: bit 0 X step, 1 X direction, 2 Y step, 3 Y
     * direction, 7 the wire is on. `in` gives bit 0 the feed clock, bit 1 stop. Without them nothing is stepped. */
    void onDrive(void (*out)(uint8_t latch), uint8_t (*in)());

    /* Power on: memory is empty. */
    void begin();

    /* The reset button: the program stays. */
    void reset();

    /* Lets it work for so many 8080 cycles; call it from loop(). */
    void run(uint32_t cycles = 20000);

  private:
    enum { KEYS = 256 };

    static int key(void *user, bool waits);
    static bool may(void *user);
    static void print(void *user, uint8_t c);
    static int read(void *user);
    static void punch(void *user, uint8_t c);
    static uint8_t drive_in(void *user);
    static void drive_out(void *user, uint8_t latch);
    void listen();

    static const small_board_lines lines;

    Stream &teletype_;
    Stream *tape_;
    uint8_t *ram_;
    size_t ram_size_;
    const uint8_t *rom_;
    void (*out_)(uint8_t) = nullptr;
    uint8_t (*in_)() = nullptr;
    small_board board_;
    uint8_t keys_[KEYS]; /* typed ahead: a ring */
    unsigned first_ = 0, count_ = 0;
    int at_once_ = SMALL_BOARD_NONE; /* ctrl-C, ctrl-S or ctrl-Q */
    uint64_t asked_ = 0; /* 8080 cycles, and the moment in us, of the last question to an empty reader */
    uint32_t asked_at_ = 0;
};

#endif
