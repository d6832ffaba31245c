/* The SKG board: memory, two serial ports, an operator. See board.h for the programmer's view. */
#include "board.h"

#include <stdlib.h>
#include <string.h>

enum {
    NO_PORT = 0x100,
    POLLS_TO_TYPE = 8,
    POLLS_TO_WAIT = 64,
    POLL_GAP = 500,         /* cycles; a wait loop asks again sooner, the firmware between two statements later */
    VAIN_READS = 1000,      /* reads of a chip before it is set up that count as normal (to empty its receiver) */
    NO_ANSWER = 0xff        /* an open bus reads so */
};

enum { DC1 = 0x11, DC2 = 0x12, DC3 = 0x13, DC4 = 0x14 };

/* Bits of the 6850's status and control, and of the 8251's status, mode and command. */
enum { ACIA_RDRF = 0x01, ACIA_TDRE = 0x02, ACIA_OVRN = 0x20, ACIA_RESET = 0x03, ACIA_RTS = 0x60, ACIA_RTS_HIGH = 0x40 };
enum {
    // clang-format off
    USART_TXRDY = 0x01, USART_RXRDY = 0x02, USART_TXE = 0x04, USART_OE = 0x10, USART_DSR = 0x80,
    MODE_BAUD = 0x03, MODE_ONE_SYNC = 0x80,
    COMMAND_TXEN = 0x01, COMMAND_RXEN = 0x04, COMMAND_ER = 0x10, COMMAND_RTS = 0x20, COMMAND_RESET = 0x40
    // clang-format on
};

/* Bits of the SIO's registers. */
enum {
    // clang-format off
    WR0_REGISTER = 0x07, WR0_COMMAND = 0x38, WR0_RESET = 0x18, WR0_ERROR_RESET = 0x30,
    WR3_RXEN = 0x01, WR5_RTS = 0x02, WR5_TXEN = 0x08,
    RR0_RX = 0x01, RR0_TX = 0x04, RR1_ALL_SENT = 0x01, RR1_OVERRUN = 0x20
    // clang-format on
};

/* The hardware of each board. */
typedef struct {
    const char *name;
    enum { CHIP_6850, CHIP_8251, CHIP_SIO } chip;
    unsigned tty, aux;  /* first port of the teletype's pair, of the punch's and reader's */
    unsigned control;   /* bit 0 of the control side's port */
    unsigned receives;  /* characters that a receiver keeps */
    unsigned ram;       /* RAM begins there */
} board_facts;

static const board_facts FACTS[] = {
    [BOARD_6850] = { "6850", CHIP_6850, 0x10, 0x12, 0, 1, 0x2000 },
    [BOARD_8251] = { "8251", CHIP_8251, 0x10, 0x12, 1, 1, 0x2000 },
    [BOARD_RC2014] = { "rc2014", CHIP_6850, 0x80, NO_PORT, 0, 1, 0x8000 },
    [BOARD_RC2014_SIO] = { "rc2014-sio", CHIP_SIO, 0x80, 0x82, 0, BOARD_RECEIVED, 0x8000 },
    [BOARD_MINIMAX8085] = { "minimax8085", CHIP_8251, 0x08, NO_PORT, 1, 1, 0x8000 },
    [BOARD_RCBUS8085] = { "rcbus8085", CHIP_6850, 0xa0, NO_PORT, 0, 1, 0x8000 },
};

static const board_facts *facts(const board *b)
{
    return &FACTS[b->kind];
}

/* ---- queues ---- */

static bool queue_add(board_queue *q, const uint8_t *bytes, size_t length)
{
    if (q->first == q->end) {
        q->first = q->end = 0;
    }
    if (length > q->size - q->end) {
        size_t size = q->end + length + 256;
        uint8_t *grown = realloc(q->bytes, size);
        if (!grown) {
            return false;
        }
        q->bytes = grown;
        q->size = size;
    }
    if (length) {
        memcpy(q->bytes + q->end, bytes, length);
    }
    q->end += length;
    return true;
}

static bool queue_empty(const board_queue *q)
{
    return q->first == q->end;
}

static uint8_t queue_take(board_queue *q)
{
    return q->bytes[q->first++];
}

/* ---- the teletype ---- */

/* Keeps the present line as it stands on the paper. */
static void follow_paper(board *b, uint8_t c)
{
    if (c == '\r' || c == '\n') {
        b->line_length = 0;
    } else if (c >= ' ' && c < 0x7f) {
        if (b->line_length == BOARD_LINE) {
            memmove(b->line, b->line + 1, BOARD_LINE - 1);
            b->line_length--;
        }
        b->line[b->line_length++] = (char)c;
    }
    b->line[b->line_length] = '\0';
    if (b->line_length == 4 && c == ' ' && !strcmp(b->line, "ERR ")) {
        b->error_lines++;
    }
}

static void tty_print(board *b, uint8_t byte)
{
    uint8_t c = byte & 0x7f;
    if (b->punch_tty) {
        if (c == DC1 || c == DC3) {
            b->reader_on = c == DC1;
        }
        if (c == DC2 || c == DC4) {
            b->punch_on = c == DC2;
        } else if (b->punch_on && b->punch) {
            b->punch(b->user, byte);
        }
    }
    follow_paper(b, c);
    if (b->paper) {
        b->paper(b->user, c);
    }
}

static uint64_t character_time(const board *b)
{
    if (!b->baud) {
        return 0;
    }
    unsigned bits = b->baud <= 110 ? 11 : 10;   /* two stop bits for a mechanical teletype */
    return (uint64_t)(bits * b->hz / b->baud);
}

/* ---- senders that do not wait ---- */

static double sender_time(const board *b, const board_sender *s)
{
    return b->hz / s->cps;
}

static void receive(board *b, board_uart *u, uint8_t c)
{
    bool lost = u->full == facts(b)->receives;
    if (lost) {
        b->lost++;
        if (facts(b)->chip == CHIP_6850) {
            u->lost = true;
            return;
        }
        u->full--;              /* it takes the place of the last one */
        u->overrun = u->overrun || facts(b)->chip == CHIP_8251;
    }
    u->behind_loss[u->full] = lost;
    u->received[u->full++] = c;
}

/* Tells whether /RTS is high at a cycle. */
static bool holds_at(const board_uart *u, double cycle)
{
    return u->holds && cycle >= (double)u->holds_from;
}

/* Puts the characters into the receiver that have come since the last look. */
static void send_what_is_due(board *b, board_uart *u, board_sender *s, board_queue *q)
{
    if (s->cps <= 0) {
        return;
    }
    while (s->running && s->due <= (double)b->cpu.cycles) {
        if (queue_empty(q)) {
            s->running = false;
        } else if (holds_at(u, s->due) && s->lag >= 0 && s->late >= s->lag) {
            break;
        } else {
            s->late += holds_at(u, s->due);
            receive(b, u, queue_take(q));
            s->due += sender_time(b, s);
        }
    }
}

/* Does the same for every sender of a port. */
static void hear(board *b, board_uart *u)
{
    if (!u->receives) {
        return;
    }
    if (u == &b->aux) {
        send_what_is_due(b, u, &b->reading, &b->tape);
        return;
    }
    send_what_is_due(b, u, &b->typing, &b->typed);
    if (b->punch_tty && b->reader_on) {
        send_what_is_due(b, u, &b->reading, &b->tape);
    }
}

/* The board asks: a sender that has characters and is not held begins. */
static void start(const board *b, const board_uart *u, board_sender *s, const board_queue *q)
{
    if (s->cps > 0 && !s->running && !u->holds && !queue_empty(q)) {
        s->running = true;
        s->due = (double)b->cpu.cycles + sender_time(b, s);
    }
}

static void let_go_on(const board *b, board_sender *s)
{
    double soonest = s->cps > 0 ? (double)b->cpu.cycles + sender_time(b, s) : 0;
    if (s->lag >= 0 && s->late >= s->lag && s->due < soonest) {
        s->due = soonest;
    }
    s->late = 0;
}

/* The board moves /RTS. */
static void set_hold(board *b, board_uart *u, bool holds)
{
    if (holds == u->holds) {
        return;
    }
    hear(b, u);
    u->holds = holds;
    u->holds_from = facts(b)->chip == CHIP_SIO ? u->sent_at : 0;
    if (u == &b->aux || b->punch_tty) {
        let_go_on(b, &b->reading);
    }
    if (u == &b->tty) {
        let_go_on(b, &b->typing);
    }
}

/* Puts the operator's next character into the receiver if it is due. */
static void tty_arrive(board *b)
{
    board_uart *u = &b->tty;
    if (u->full || b->cpu.cycles < u->arrived_at) {
        return;
    }
    board_queue *from = NULL;
    if (!queue_empty(&b->pressed)) {
        from = &b->pressed;
    } else if (b->polls >= POLLS_TO_TYPE && !u->holds) {
        if (!queue_empty(&b->typed)) {
            from = b->typing.cps > 0 ? NULL : &b->typed;
        } else if (b->punch_tty && b->reader_on && !queue_empty(&b->tape)) {
            from = b->reading.cps > 0 ? NULL : &b->tape;
        }
    }
    if (from) {
        receive(b, u, queue_take(from));
        u->arrived_at = b->cpu.cycles + character_time(b);
    }
}

/* The board has looked whether there is a character and found none; `idle`: it could have sent one. */
static void count_poll(board *b, bool idle)
{
    uint64_t now = b->cpu.cycles;
    idle = idle && !b->tty.holds;
    b->polls = idle && now - b->polled_at <= POLL_GAP ? b->polls + 1 : 0;
    b->polled_at = now;
    if (b->polls >= POLLS_TO_WAIT && board_idle(b) && !(b->punch_tty && b->reader_on && !queue_empty(&b->tape))) {
        b->waiting = true;
        i8080_stop(&b->cpu);
    }
}

/* ---- serial ports ---- */

static bool is_tty(const board *b, const board_uart *u)
{
    return u == &b->tty;
}

/* Readiness of the two directions, for the status. */
static bool can_send(const board *b, const board_uart *u)
{
    return u->sends && b->cpu.cycles >= u->sent_at;
}

static bool has_received(board *b, board_uart *u)
{
    if (!u->receives) {
        return false;
    }
    hear(b, u);
    if (is_tty(b, u)) {
        start(b, u, &b->typing, &b->typed);
        if (b->punch_tty && b->reader_on) {
            start(b, u, &b->reading, &b->tape);
        }
        tty_arrive(b);
        if (!u->full) {
            count_poll(b, can_send(b, u));
        }
    } else if (b->reading.cps > 0 && !queue_empty(&b->tape)) {
        start(b, u, &b->reading, &b->tape);
    } else if (!u->full && (!u->holds || b->reading.late < b->reading.lag) && !queue_empty(&b->tape)) {
        b->reading.late += u->holds;
        receive(b, u, queue_take(&b->tape));
    } else if (!u->full && queue_empty(&b->tape)) {
        if (b->cpu.cycles - b->reader_asked_at > POLL_GAP) {
            b->reader_asked_since = b->cpu.cycles;
        }
        b->reader_asked_at = b->cpu.cycles;
    }
    return u->full;
}

static uint8_t read_data(board *b, board_uart *u)
{
    if (u->full && is_tty(b, u)) {
        drive_key(&b->drive);
    }
    hear(b, u);
    uint8_t c = u->received[0];
    if (facts(b)->chip == CHIP_6850) {
        u->full = u->lost;              /* the character stays, and OVRN is shown */
        u->overrun = u->lost;
        u->lost = false;
    } else if (u->full) {
        u->overrun = u->overrun || u->behind_loss[0];
        u->full--;
        memmove(u->received, u->received + 1, u->full);
        memmove(u->behind_loss, u->behind_loss + 1, u->full);
    }
    return c;
}

static void write_data(board *b, board_uart *u, uint8_t byte)
{
    if (!can_send(b, u)) {
        return;                 /* lost, as on the chip */
    }
    if (is_tty(b, u)) {
        bool puts_off = u->holds && b->cpu.cycles < u->holds_from;
        u->sent_at = b->cpu.cycles + character_time(b);
        u->holds_from = puts_off ? u->sent_at : u->holds_from;
        tty_print(b, byte);
    } else if (b->punch) {
        b->punch(b->user, byte);
    }
}

static uint8_t read_status(board *b, board_uart *u)
{
    bool full = has_received(b, u);
    bool empty = can_send(b, u);
    if (facts(b)->chip == CHIP_SIO) {
        return (uint8_t)((full ? RR0_RX : 0) | (empty ? RR0_TX : 0));
    }
    if (facts(b)->chip == CHIP_6850) {
        return (uint8_t)((full ? ACIA_RDRF : 0) | (empty ? ACIA_TDRE : 0) | (u->overrun ? ACIA_OVRN : 0));
    }
    return (uint8_t)((full ? USART_RXRDY : 0) | (empty ? USART_TXRDY | USART_TXE : 0) | (u->overrun ? USART_OE : 0)
                     | USART_DSR);
}

static void uart_reset(board *b, board_uart *u)
{
    memset(u, 0, sizeof *u);
    u->state = facts(b)->chip == CHIP_6850 ? UART_DEAD : UART_RESET;
}

static void acia_control(board *b, board_uart *u, uint8_t word)
{
    if ((word & ACIA_RESET) == ACIA_RESET) {
        u->state = UART_RESET;
        u->full = 0;
        u->lost = u->overrun = false;
    } else if (u->state != UART_DEAD) {
        u->state = UART_READY;
    }
    u->sends = u->receives = u->state == UART_READY;
    set_hold(b, u, (word & ACIA_RTS) == ACIA_RTS_HIGH);
}

static void usart_control(board *b, board_uart *u, uint8_t word)
{
    switch (u->state) {
    case UART_RESET:
        u->synchronous = !(word & MODE_BAUD);
        u->state = !u->synchronous ? UART_READY : word & MODE_ONE_SYNC ? UART_SYNC1 : UART_SYNC2;
        break;
    case UART_SYNC2:
        u->state = UART_SYNC1;
        break;
    case UART_SYNC1:
        u->state = UART_READY;
        break;
    default:
        if (word & COMMAND_RESET) {
            uart_reset(b, u);
        } else {
            u->sends = (word & COMMAND_TXEN) && !u->synchronous;
            u->receives = (word & COMMAND_RXEN) && !u->synchronous;
            u->overrun = u->overrun && !(word & COMMAND_ER);
            set_hold(b, u, !(word & COMMAND_RTS));
        }
    }
}

static void sio_control(board *b, board_uart *u, uint8_t word)
{
    unsigned chosen = u->chosen;
    u->chosen = 0;
    switch (chosen) {
    case 0:
        u->chosen = word & WR0_REGISTER;
        if ((word & WR0_COMMAND) == WR0_RESET) {
            uart_reset(b, u);
        } else if ((word & WR0_COMMAND) == WR0_ERROR_RESET) {
            u->overrun = false;
        }
        break;
    case 3:
        u->receives = word & WR3_RXEN;
        break;
    case 5:
        u->sends = word & WR5_TXEN;
        set_hold(b, u, !(word & WR5_RTS));
        break;
    default:
        break;
    }
    if (u->sends || u->receives) {
        u->state = UART_READY;
    }
}

/* RR0, or RR1 when WR0 has named it. */
static uint8_t read_sio(board *b, board_uart *u)
{
    unsigned chosen = u->chosen;
    u->chosen = 0;
    if (chosen != 1) {
        return chosen ? 0 : read_status(b, u);
    }
    hear(b, u);
    bool overrun = u->overrun || (u->full && u->behind_loss[0]);
    return (uint8_t)((overrun ? RR1_OVERRUN : 0) | (can_send(b, u) ? RR1_ALL_SENT : 0));
}

/* The port's chip, and whether it is its control side; NULL where there is none: a teletype alone has one chip. */
static board_uart *find_uart(board *b, uint8_t port, bool *control)
{
    unsigned pair = port & ~1U;
    *control = (port & 1) == facts(b)->control;
    if (pair == b->tty_ports) {
        return &b->tty;
    }
    return pair == b->aux_ports && !b->punch_tty ? &b->aux : NULL;
}

/* The board reads a port without a chip, or a chip that is not set up yet. */
static void ask_in_vain(board *b, uint8_t port, board_uart *u)
{
    if (!u || ++u->asked_in_vain == VAIN_READS) {
        b->nobody = true;
        b->nobody_port = port;
        b->nobody_chip = u != NULL;
        b->nobody_synchronous = u && u->synchronous;
        i8080_stop(&b->cpu);
    }
}

static uint8_t port_in(void *user, uint8_t port)
{
    board *b = user;
    bool control;
    board_uart *u = find_uart(b, port, &control);
    if (!(u && control && is_tty(b, u))) {
        b->polls = 0;
    }
    if (port == DRIVE_PORT) {
        return drive_in(&b->drive, b->cpu.cycles, b->hz);
    }
    if (!u || u->state != UART_READY || u->synchronous) {
        ask_in_vain(b, port, u);
    }
    if (!u) {
        return NO_ANSWER;
    }
    if (!control) {
        return read_data(b, u);
    }
    return facts(b)->chip == CHIP_SIO ? read_sio(b, u) : read_status(b, u);
}

static void port_out(void *user, uint8_t port, uint8_t value)
{
    board *b = user;
    bool control;
    board_uart *u = find_uart(b, port, &control);
    bool asks = control && (!u || u->state == UART_READY);  /* it moves /RTS while it asks */
    if (!asks) {
        b->polls = 0;
        b->reader_asked_at = 0;
    }
    if (port == DRIVE_PORT) {
        drive_out(&b->drive, value, b->cpu.cycles, b->user);
    }
    if (!u) {
        return;
    }
    if (!control) {
        write_data(b, u, value);
    } else if (facts(b)->chip == CHIP_6850) {
        acia_control(b, u, value);
    } else if (facts(b)->chip == CHIP_8251) {
        usart_control(b, u, value);
    } else {
        sio_control(b, u, value);
    }
}

/* ---- the interface ---- */

const char *board_name(board_kind kind)
{
    return FACTS[kind].name;
}

bool board_is_alone(board_kind kind)
{
    return FACTS[kind].aux == NO_PORT;
}

const char *board_chip(board_kind kind)
{
    static const char *const names[] = { [CHIP_6850] = "6850", [CHIP_8251] = "8251", [CHIP_SIO] = "SIO" };
    return names[FACTS[kind].chip];
}

bool board_has_port(board_kind kind, uint8_t port)
{
    unsigned pair = port & ~1U;
    return pair == FACTS[kind].tty || pair == FACTS[kind].aux;
}

unsigned board_ram_start(board_kind kind)
{
    return FACTS[kind].ram;
}

unsigned board_ram_end(board_kind kind, unsigned ram_kib)
{
    unsigned end = board_ram_start(kind) + ram_kib * 1024;
    return end < I8080_SPACE ? end : I8080_SPACE;
}

board *board_new(board_kind kind, unsigned ram_kib)
{
    board *b = calloc(1, sizeof *b);
    if (!b) {
        return NULL;
    }
    b->kind = kind;
    b->hz = BOARD_HZ;
    drive_init(&b->drive);
    i8080_init(&b->cpu, port_in, port_out, b);
    i8080_map(&b->cpu, 0, BOARD_ROM_SIZE - 1, I8080_ROM);
    b->tty_ports = FACTS[kind].tty;
    b->aux_ports = FACTS[kind].aux;
    b->punch_tty = board_is_alone(kind);
    unsigned ram_start = board_ram_start(kind), ram_end = board_ram_end(kind, ram_kib);
    if (ram_start > BOARD_ROM_SIZE) {
        i8080_map(&b->cpu, BOARD_ROM_SIZE, (uint16_t)(ram_start - 1), I8080_OPEN);
    }
    if (ram_end < I8080_SPACE) {
        i8080_map(&b->cpu, (uint16_t)ram_end, 0xffff, I8080_OPEN);
    }
    board_rom(b, NULL, 0);
    board_reset(b);
    return b;
}

void board_free(board *b)
{
    if (b) {
        free(b->typed.bytes);
        free(b->pressed.bytes);
        free(b->tape.bytes);
        free(b);
    }
}

void board_rom(board *b, const uint8_t *bytes, size_t length)
{
    for (size_t i = 0; i < BOARD_ROM_SIZE; i++) {
        i8080_poke(&b->cpu, (uint16_t)i, i < length ? bytes[i] : 0xff);
    }
}

void board_reset(board *b)
{
    i8080_reset(&b->cpu);
    uart_reset(b, &b->tty);
    uart_reset(b, &b->aux);
    drive_reset(&b->drive);
    b->polls = 0;
    b->waiting = b->nobody = b->reader_on = b->punch_on = false;
    b->reader_asked_at = 0;
    b->line_length = 0;
    b->line[0] = '\0';
}

bool board_type(board *b, const uint8_t *bytes, size_t length)
{
    return queue_add(&b->typed, bytes, length);
}

bool board_press(board *b, uint8_t key)
{
    return queue_add(&b->pressed, &key, 1);
}

bool board_tape(board *b, const uint8_t *bytes, size_t length)
{
    return queue_add(&b->tape, bytes, length);
}

void board_take_tape(board *b)
{
    b->tape.first = b->tape.end;
    b->reading.running = false;
    b->aux.full = 0;
    b->aux.lost = b->aux.overrun = false;
}

void board_forget_typed(board *b)
{
    b->typed.first = b->typed.end;
    b->pressed.first = b->pressed.end;
    b->typing.running = false;
}

void board_reader(board *b, bool on)
{
    b->reader_on = on;
}

uint64_t board_reader_silence(const board *b)
{
    bool asks = b->reader_asked_at && b->cpu.cycles - b->reader_asked_at <= POLL_GAP;
    return asks ? b->cpu.cycles - b->reader_asked_since : 0;
}

bool board_idle(const board *b)
{
    return queue_empty(&b->typed) && queue_empty(&b->pressed);
}

board_reason board_run(board *b, uint64_t cycles)
{
    if (b->waiting) {
        b->waiting = false;     /* reported: the next report takes as many questions again */
        b->polls = 0;
    }
    b->nobody = false;
    i8080_reason reason = i8080_run(&b->cpu, cycles);
    switch (reason) {
    case I8080_HALTED:
        return BOARD_HALT;
    case I8080_BREAK:
        return BOARD_BREAK;
    case I8080_CYCLES:
        return BOARD_CYCLES;
    default:
        break;
    }
    if (b->nobody) {
        return BOARD_NOBODY;
    }
    if (!strcmp(b->line, ">")) {
        return BOARD_PROMPT;
    }
    if (b->line_length >= 2 && !strcmp(b->line + b->line_length - 2, "? ")) {
        return BOARD_INPUT;
    }
    return BOARD_WAIT;
}
