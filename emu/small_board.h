/* The SKG board around the small core: two serial lines and the drive's port, for a microcontroller
 *
 *      port        in                                          out
 *      10H         teletype: b0 a key is there, b1 may print   control: b6 b5 = 10 /RTS high
 *      11H         teletype: the key                           a character of the paper
 *      12H         b0 the reader has a character, b1 may punch (control)
 *      13H         reader: the character                       punch
 *      14H         drive: b0 feed clock, b1 stop               drive's latch (docs/spec/drive.md)
 *
 * These are the ports of roms/skg.bin and of the images for the same board. The chips need no setting up, and no
 * character is ever lost in them: the board asks its host for the next one when the ROM wants it.
 *
 * The ROM looks at the keyboard while it prints and works, but remembers one key only. So a key is handed over when the
 * ROM waits for one: /RTS is low, and it has asked so often in close succession, and could have printed. ctrl-C, ctrl-S
 * and ctrl-Q are wanted at once; the host sees to that.
 *
 * NOT IMPLEMENTED: /RTS of the second line, baud rates, overrun.
 */
#ifndef SMALL_BOARD_H
#define SMALL_BOARD_H

#include "i8080_small.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { SMALL_BOARD_ROM = 0x2000, SMALL_BOARD_NONE = -1 };

/* The host's side of the lines. All are called with `user`, from small_board_run. */
typedef struct {
    /* The next key, or SMALL_BOARD_NONE. While the ROM does not wait for one, only ctrl-C, ctrl-S, ctrl-Q. */
    int (*key)(void *user, bool waits);
    bool (*may_print)(void *user);
    void (*print)(void *user, uint8_t c);       /* 7 bits */
    int (*reader)(void *user);                  /* the reader's next character, or SMALL_BOARD_NONE */
    bool (*may_punch)(void *user);
    void (*punch)(void *user, uint8_t c);
    uint8_t (*drive_in)(void *user);
    void (*drive_out)(void *user, uint8_t latch);
} small_board_lines;

typedef struct {
    i8080_small cpu;
    uint8_t latch;              /* what was last written to the drive's port */

    /* The rest is the board's own. */
    const small_board_lines *lines;
    void *user;
    int key, read;              /* in the receivers, or SMALL_BOARD_NONE */
    bool holds;                 /* the teletype's /RTS is high */
    uint8_t printed;            /* the paper's last character */
    unsigned asked, reader_asked;   /* questions in close succession, of the teletype and of the reader */
    uint64_t asked_at, reader_asked_at;
} small_board;

/* A board with the ROM of 8,192 bytes, and RAM from 2000 up: ram_size bytes, a multiple of 1,024, at most 57,344. */
void small_board_init(small_board *b, const uint8_t *rom, uint8_t *ram, size_t ram_size, const small_board_lines *lines,
                      void *user);

/* The reset button. Memory stays. */
void small_board_reset(small_board *b);

/* Runs until at least so many more 8080 cycles have passed. */
void small_board_run(small_board *b, uint64_t cycles);

/* True when the ROM waits for a key. */
bool small_board_waits(const small_board *b);

/* True when the ROM waits for the first key of a line behind its prompt. (Memory may be copied then.) */
bool small_board_at_prompt(const small_board *b);

/* The host has printed a prompt of its own. */
void small_board_prompted(small_board *b);

/* True when the ROM waits for the reader. */
bool small_board_waits_for_reader(const small_board *b);

#ifdef __cplusplus
}
#endif

#endif
