/* The SKG board: 8080A, 8 KiB ROM at 0000, RAM from 2000, two serial ports, a drive
 *
 *      port    standard board (MITS 88-2SIO)           BOARD=8251
 *      10H     teletype  6850 status / control         teletype  8251 data
 *      11H     teletype  6850 data                     teletype  8251 status / mode, command
 *      12H     punch and reader  6850 status / control punch and reader  8251 data
 *      13H     punch and reader  6850 data             punch and reader  8251 status / mode, command
 *      14H     drive (drive.h)                         drive
 *
 *      BOARD=RC2014: one 6850, status and control at 80H, data at 81H, which is the teletype, its punch and its reader; RAM from 8000.
 *      BOARD=RCBUS8085: the same at A0H and A1H.  BOARD=MINIMAX8085: one 8251 instead, data at 08H, status and control at 09H.
 *      BOARD=RC2014-SIO: a Z80 SIO, channel A (80H control, 81H data) the teletype, B (82H, 83H) punch and reader; RAM from 8000.
 *
 *                      b7    b6    b5    b4    b3    b2    b1    b0
 *      6850 status     IRQ   PE    OVRN  FE    CTS   DCD   TDRE  RDRF      control xxxxxx11: master reset
 *      8251 status     DSR   SYN   FE    OE    PE    TxE   RxRDY TxRDY     command x1xxxxxx: reset, a mode follows
 *      SIO  RR0                                      TxE         RxRDY     WR0: register, command
 *           RR1                    OVRN                          sent
 *
 * A 6850 is dead after power-on until its master reset has been followed by another control word; an 8251 takes a mode
 * word first (and one or two sync characters when the mode is synchronous), then commands, of which bit 0 lets it send
 * and bit 2 receive; an SIO sends and receives when WR5 and WR3 say so. A synchronous 8251 does neither here.
 *
 * The programmer's view of the outside: a teletype with an operator, a paper tape reader with one tape in it, and a
 * punch. With `punch_tty` there is the teletype alone: its own punch is on from DC2 to DC4, its own reader from DC1 (or
 * the operator's lever) to DC3, and the reader's characters come in like typed ones.
 *
 * The operator types with care: a character arrives when the board waits for one, that is, when it has asked
 * POLLS_TO_TYPE times in close succession and could have sent if it had wanted to, and /RTS is low. Pressed keys
 * (ctrl-C, ctrl-S, ctrl-Q) arrive at once. The reader's tape waits likewise.
 *
 * With a `board_sender` whose `cps` is not 0, typed characters, or the tape, come at that rate whether the board is
 * ready or not: a character that comes to a full receiver is lost. A 6850 keeps the old character then and shows OVRN
 * behind it, with that character once more; an 8251 keeps the new one, and OE stays until a command resets it; an SIO
 * keeps three, the last of which the new one replaces, and RR1 shows OVRN when that is read, until a command resets it.
 * /RTS of an SIO rises when all is sent. A sender that looks at /RTS stops `lag` characters late. The tape starts when
 * the board first asks for it.
 *
 * The board counts as waiting for the operator after POLLS_TO_WAIT such questions, whether they were asked in one run
 * or in many short ones.
 *
 * A ROM made for another board asks ports without a chip, or with one that it has never set up (or made synchronous), and
 * would ask for ever: board_run returns BOARD_NOBODY. Writes to such ports are lost silently, as on a real board.
 *
 * NOT IMPLEMENTED: interrupts; parity and framing errors; modem lines that come in (CTS, DCD, DSR are always on);
 * synchronous mode; loss of bits that the control word's format leaves out.
 */
#ifndef BOARD_H
#define BOARD_H

#include "drive.h"
#include "i8080.h"

enum {
    BOARD_ROM_SIZE = 0x2000,
    BOARD_RAM_MIN_KIB = 2,
    BOARD_RAM_MAX_KIB = 56,
    BOARD_RAM_KIB = 8,
    BOARD_HZ = 2000000,
    BOARD_RECEIVED = 3,             /* characters that a receiver keeps at the most */
    BOARD_LINE = 132                /* characters of the paper's present line that are remembered */
};

/* Why board_run came back. */
typedef enum {
    BOARD_CYCLES,       /* the cycles are used up */
    BOARD_PROMPT,       /* waits at the prompt: the paper's last line is `>` */
    BOARD_INPUT,        /* waits for the answer to INPUT: the paper's last line ends in `? ` */
    BOARD_WAIT,         /* waits for a key anywhere else */
    BOARD_HALT,         /* HLT: nothing but a reset helps */
    BOARD_BREAK,        /* at a breakpoint of the core's */
    BOARD_NOBODY        /* read a port without a working chip: see nobody_port; the next run goes on */
} board_reason;

/* A queue of bytes that grows as needed. */
typedef struct {
    uint8_t *bytes;
    size_t first, end, size;
} board_queue;

/* The standard board; one with two 8251s; those with RAM from 8000: an RC2014 with one 6850 (`punch_tty` is its only line), or with
 * an SIO; a MiniMax8085 and an RCBus with an 8085 (one line, too). */
typedef enum {
    BOARD_6850,
    BOARD_8251,
    BOARD_RC2014,
    BOARD_RC2014_SIO,
    BOARD_MINIMAX8085,
    BOARD_RCBUS8085,
    BOARD_KINDS
} board_kind;

/* The pace at which characters come into a receiver. */
typedef struct {
    double cps; /* characters a second; 0: each one waits until the board wants it */
    int lag; /* characters that still come after /RTS has risen; negative: the sender ignores /RTS (with a pace) */
    bool running; /* the next one is under way, */
    double due; /* the cycle at which it arrives */
    int late; /* characters sent since /RTS has risen */
} board_sender;

/* One serial port. */
typedef struct {
    enum { UART_DEAD, UART_RESET, UART_SYNC2, UART_SYNC1, UART_READY } state;
    bool synchronous; /* (8251) */
    bool sends, receives;
    bool holds; /* /RTS is high, */
    uint64_t holds_from; /* from this cycle on */
    unsigned full; /* received characters that have not been read */
    bool lost; /* characters behind it are lost; the status does not show that yet (6850), */
    bool overrun; /* or shows it */
    unsigned chosen; /* the SIO's register for the next access */
    uint8_t received[BOARD_RECEIVED];
    bool behind_loss[BOARD_RECEIVED]; /* characters in front of it are lost (SIO) */
    unsigned asked_in_vain; /* reads since it was reset, while it was not ready */
    uint64_t sent_at, arrived_at; /* cycle at which the line is free again for the next character */
} board_uart;

typedef void board_sink(void *user, uint8_t byte);

typedef struct board {
    i8080 cpu;
    board_kind kind;
    /* Set these before the first run. */
    unsigned tty_ports, aux_ports; /* the lower port of each pair, teletype's and punch's: the board's own, or others */
    bool punch_tty;
    double hz; /* the processor's clock */
    unsigned baud; /* the teletype's line; 0: no time at all */
    board_sink *paper, *punch; /* what the teletype prints (7 bits), what the punch punches (8 bits) */
    void *user; /* of these two and of the drive's */
    drive drive;

    board_sender typing, reading; /* of the keyboard and of the tape */
    uint64_t lost; /* characters for which a receiver had no place */
    board_queue typed, pressed, tape;
    bool reader_on; /* the teletype's own reader (punch_tty) */
    bool punch_on; /* the teletype's own punch (punch_tty) */
    char line[BOARD_LINE + 1]; /* the paper's present line */
    size_t line_length;
    unsigned error_lines; /* lines on the paper that begin with `ERR ` */
    uint8_t nobody_port; /* the port of the last BOARD_NOBODY, */
    bool nobody_chip; /* and whether it has a chip, never set up, */
    bool nobody_synchronous; /* or set up as a synchronous one */

    /* The rest is the board's own. */
    board_uart tty, aux;
    bool nobody; /* BOARD_NOBODY is due */
    uint64_t reader_asked_at, reader_asked_since;
    unsigned polls; /* questions in close succession */
    uint64_t polled_at;
    uint64_t end;
    bool waiting;
} board;

/* A board's name, as --board takes it; whether its only line is the teletype's. */
const char *board_name(board_kind kind);
bool board_is_alone(board_kind kind);

/* The name of a board's chips, and whether one is at a port. */
const char *board_chip(board_kind kind);
bool board_has_port(board_kind kind, uint8_t port);

/* The first address of a board's RAM, and the address behind the end of so many KiB of it. */
unsigned board_ram_start(board_kind kind);
unsigned board_ram_end(board_kind kind, unsigned ram_kib);

/* A board with that much RAM (KiB), all of it zero, and nothing in its ROM; NULL without memory. Free with
 * board_free. */
board *board_new(board_kind kind, unsigned ram_kib);
void board_free(board *b);

/* Puts up to BOARD_ROM_SIZE bytes into the ROM; the rest of it reads FF. */
void board_rom(board *b, const uint8_t *bytes, size_t length);

/* The reset button: processor, serial ports and drive; memory stays. */
void board_reset(board *b);

/* The operator: types when asked, presses a key now, puts a tape into the reader (behind the rest of the old).
 * False without memory. */
bool board_type(board *b, const uint8_t *bytes, size_t length);
bool board_press(board *b, uint8_t key);
bool board_tape(board *b, const uint8_t *bytes, size_t length);

/* Takes the rest of the tape out of the reader. */
void board_take_tape(board *b);

/* Drops typed and pressed characters that have not arrived yet. */
void board_forget_typed(board *b);

/* The operator moves the lever of the teletype's own reader (punch_tty). */
void board_reader(board *b, bool on);

/* Cycles for which the board has polled the empty reader and used no other port; 0: it is not polling it. */
uint64_t board_reader_silence(const board *b);

/* True when everything typed and pressed has been taken by the board. */
bool board_idle(const board *b);

/* Runs until the board waits for the operator with all typed characters taken, or the cycles are used up. */
board_reason board_run(board *b, uint64_t cycles);

#endif
