/* Two serial lines over USB. See usb.h. Out of the RP2040's data sheet (USB) and the specifications USB 2.0, CDC 1.2 and
 * PSTN 1.2.
 *
 * The vendor and product numbers are those that Raspberry Pi's SDK gives to a serial line: SKG has none of its own.
 */
#include "usb.h"
#include "chip.h"

#include <string.h>

/* ---- the controller ---- */

enum {
    MEMORY = 0x50100000,
    USB = 0x50110000,
    ADDRESS = USB,
    MAIN_CTRL = USB + 0x40,
    SOF = USB + 0x48, /* the number of the millisecond's frame */
    SIE_CTRL = USB + 0x4c,
    SIE_STATUS = USB + 0x50,
    BUFF_STATUS = USB + 0x58,
    STALL_ARM = USB + 0x68,
    MUXING = USB + 0x74,
    POWER = USB + 0x78
};

enum { ENABLE = 1 << 0, PULLUP = 1 << 16, EP0_INTERRUPT = 1 << 29 };
enum { TO_PHY = 1 << 0, SOFTCON = 1 << 3, VBUS = 1 << 2, VBUS_OVERRIDE = 1 << 3 };
enum { BUS_RESET = 1 << 19, SETUP = 1 << 17, SUSPENDED = 1 << 4, RESUMED = 1 << 11 };

/* A buffer's control word. */
enum { FULL = 1 << 15, DATA1 = 1 << 13, STALL = 1 << 11, AVAILABLE = 1 << 10, LENGTH = 0x3ff };

/* An endpoint's control word. */
enum { EP_ENABLE = 1u << 31, EP_INTERRUPT = 1 << 29, BULK = 2 << 26, INTERRUPT = 3 << 26 };

enum { SIZE = 64, NOTICE_SIZE = 8 };

/* Endpoints: of each line one for notices, which never come, and one for data in both directions. Their buffers. */
enum { TTY_NOTICE = 1, TTY_DATA, PUNCH_NOTICE, PUNCH_DATA, ENDPOINTS };
#define BUFFER_OF(endpoint, out) (0x180u + ((endpoint) * 2u + (out)) * SIZE)
#define CONTROL(endpoint, out) REG(MEMORY + (endpoint) * 8u + (out) * 4u)
#define BUFFER(endpoint, out) REG(MEMORY + 0x80u + (endpoint) * 8u + (out) * 4u)
#define BYTES(offset) ((volatile uint8_t *)(uintptr_t)(MEMORY + (offset)))
enum { EP0_BYTES = 0x100 };

/* ---- descriptors ---- */

enum { DEVICE = 1, CONFIGURATION = 2, STRING = 3 };
enum { LANGUAGES, MAKER, PRODUCT, TTY_NAME, PUNCH_NAME, STRINGS };

static const uint8_t device[18] = {
    18,   DEVICE, 0x00, 0x02, 0xef, 2,    1,     SIZE, /* USB 2.0; functions of more than one interface */
    0x8a, 0x2e,   0x0a, 0x00, 0x83, 0x19, MAKER, PRODUCT, 0, 1
};

// clang-format off
#define LINE(first, name, notice, data)                                                                                 \
    8, 11, first, 2, 2, 2, 0, name,             /* interfaces that belong together: CDC, abstract control, no AT */     \
    9, 4, first, 0, 1, 2, 2, 0, name,           /* interface */                                                         \
    5, 0x24, 0, 0x20, 1,                        /* CDC 1.2 */                                                           \
    5, 0x24, 1, 0, (first) + 1,                 /* calls: none */                                                       \
    4, 0x24, 2, 6,                              /* takes line coding, line state and break */                           \
    5, 0x24, 6, first, (first) + 1,             /* union */                                                             \
    7, 5, 0x80 | (notice), 3, NOTICE_SIZE, 0, 255,                                                                      \
    9, 4, (first) + 1, 0, 2, 10, 0, 0, 0,       /* data interface */                                                    \
    7, 5, 0x80 | (data), 2, SIZE, 0, 0,                                                                                 \
    7, 5, data, 2, SIZE, 0, 0

enum { CONFIGURATION_SIZE = 9 + USB_LINES * 66 };

static const uint8_t configuration[] = {
    9, CONFIGURATION, CONFIGURATION_SIZE, 0, 2 * USB_LINES, 1, 0, 0x80, 125,   /* from the bus, up to 250 mA */
    LINE(0, TTY_NAME, TTY_NOTICE, TTY_DATA),
    LINE(2, PUNCH_NAME, PUNCH_NOTICE, PUNCH_DATA)
};
// clang-format on

/* (an answer of whole packets would want an empty one behind it) */
_Static_assert(sizeof configuration == CONFIGURATION_SIZE && CONFIGURATION_SIZE % SIZE, "the configuration's length");

static const char *const strings[STRINGS] = { NULL, "SKG", "SKG 8080 board", "SKG teletype", "SKG punch and reader" };

/* ---- a line ---- */

enum { QUEUE = 4096, RAW_AFTER_MS = 100, SHUT_AFTER_MS = 50, AWAKE_MS = 10 };

enum { CTRL_C = 3, CTRL_Q = 17, CTRL_S = 19 };

typedef struct {
    uint8_t bytes[QUEUE];
    uint32_t in, out; /* counted on and on */
} queue;

typedef struct {
    queue received, paper;
    uint8_t coding[7]; /* rate, stop bits, parity, bits: kept for the host, which asks for it; it means nothing here */
    bool dtr;
    bool gap; /* characters of the paper were dropped */
    uint32_t turned; /* when DTR rose or fell, us */
    bool sending, listening, ends; /* ends: the host waits for a short packet */
    uint32_t under_way; /* characters of the paper in the packet that is sent */
    uint32_t send_pid, listen_pid;
} line;

static const uint8_t data_endpoint[USB_LINES] = { TTY_DATA, PUNCH_DATA };

static line lines[USB_LINES];
static queue at_once;
static bool configured, broken;
static uint32_t frame, frame_at;

static uint32_t held(const queue *q)
{
    return q->in - q->out;
}

static void append(queue *q, uint8_t c)
{
    q->bytes[q->in++ % QUEUE] = c;
}

/* The controller's clock is the slower one: AVAILABLE is set when the rest of the word has arrived (data sheet 4.1.2.5.1). */
static void arm(uint32_t endpoint, uint32_t out, uint32_t word)
{
    BUFFER(endpoint, out) = word;
    __asm__ volatile("nop\nnop\nnop\nnop\nnop\nnop\nnop\nnop\nnop\nnop\nnop\nnop");
    BUFFER(endpoint, out) = word | AVAILABLE;
}

static void listen(line *l, uint32_t endpoint)
{
    if (!l->listening && QUEUE - held(&l->received) >= SIZE) {
        l->listening = true;
        arm(endpoint, 1, l->listen_pid | SIZE);
        l->listen_pid ^= DATA1;
    }
}

/* Nothing is sent for 100 ms after the line is opened: until then the host's terminal echoes what it receives. */
static void send(line *l, uint32_t endpoint)
{
    bool due = held(&l->paper) || l->ends;
    if (l->sending || !due || !l->dtr || chip_micros() - l->turned < RAW_AFTER_MS * 1000u) {
        return;
    }
    uint32_t n = 0, marked;
    volatile uint8_t *to = BYTES(BUFFER_OF(endpoint, 0));
    if (l->gap) {
        l->gap = false;
        for (const char *mark = "\r\n...\r\n"; *mark; mark++) {
            to[n++] = (uint8_t)*mark;
        }
    }
    marked = n;
    while (n < SIZE && n - marked < held(&l->paper)) {
        to[n] = l->paper.bytes[(l->paper.out + n - marked) % QUEUE];
        n++;
    }
    l->under_way = n - marked;
    l->ends = n == SIZE;
    l->sending = true;
    arm(endpoint, 0, FULL | l->send_pid | n);
    l->send_pid ^= DATA1;
}

/* The packets of an endpoint begin anew: the host has configured the device, or has cleared the endpoint's halt. What was
 * under way is sent once more. */
static void begin(line *l, uint32_t endpoint, bool out)
{
    BUFFER(endpoint, out) = 0;
    if (out) {
        l->listening = false;
        l->listen_pid = 0;
    } else {
        l->sending = l->ends = false;
        l->send_pid = 0;
    }
}

/* The line is shut, and the host has stopped reading: what was under way waits for the next program that opens it. But
 * a tape does not begin with the rest of another one. */
static void shut(line *l, uint32_t endpoint)
{
    if (l->dtr || chip_micros() - l->turned < SHUT_AFTER_MS * 1000u) {
        return;
    }
    if (l->sending) {
        BUFFER(endpoint, 0) = 0;
        l->sending = l->ends = false;
        l->send_pid ^= DATA1;
    }
    if (l == &lines[USB_PUNCH]) {
        l->paper.out = l->paper.in;
    }
}

static void hear_key(line *l, uint8_t c)
{
    if (c == CTRL_C) {
        l->received.out = l->received.in;
        at_once.out = at_once.in;
    }
    append(c == CTRL_C || c == CTRL_S || c == CTRL_Q ? &at_once : &l->received, c);
}

static void hear(line *l, uint32_t endpoint)
{
    uint32_t n = BUFFER(endpoint, 1) & LENGTH;
    for (uint32_t i = 0; i < n; i++) {
        uint8_t c = BYTES(BUFFER_OF(endpoint, 1))[i];
        if (l == &lines[USB_TELETYPE]) {
            hear_key(l, c);
        } else {
            append(&l->received, c);
        }
    }
    l->listening = false;
}

static void sent(line *l)
{
    l->paper.out += l->under_way;
    l->under_way = 0;
    l->sending = false;
}

/* ---- endpoint 0 ---- */

static const uint8_t *reply;
static uint32_t left, pid0, new_address;
static uint8_t made[2 + 2 * 32]; /* a reply that is put together */
static line *takes_coding;

static void send_reply(void)
{
    uint32_t n = left < SIZE ? left : SIZE;
    for (uint32_t i = 0; i < n; i++) {
        BYTES(EP0_BYTES)[i] = reply[i];
    }
    reply += n;
    left -= n;
    arm(0, 0, FULL | pid0 | n);
    pid0 ^= DATA1;
}

static void answer(const uint8_t *bytes, uint32_t length, uint32_t wanted)
{
    reply = bytes;
    left = length < wanted ? length : wanted;
    pid0 = DATA1;
    send_reply();
}

static void acknowledge(void)
{
    answer(NULL, 0, 0);
}

static void refuse(void)
{
    SET(STALL_ARM) = 1 | 1 << 1;
    BUFFER(0, 0) = STALL;
    BUFFER(0, 1) = STALL;
}

static void answer_string(uint32_t number, uint32_t wanted)
{
    if (number >= STRINGS) {
        refuse();
        return;
    }
    uint32_t n = 2;
    if (number == LANGUAGES) {
        made[n++] = 0x09; /* English */
        made[n++] = 0x04;
    } else {
        for (const char *c = strings[number]; *c; c++) {
            made[n++] = (uint8_t)*c;
            made[n++] = 0;
        }
    }
    made[0] = (uint8_t)n;
    made[1] = STRING;
    answer(made, n, wanted);
}

static void answer_number(uint32_t number, uint32_t length, uint32_t wanted)
{
    made[0] = (uint8_t)number;
    made[1] = 0;
    answer(made, length, wanted);
}

static void answer_descriptor(uint32_t kind, uint32_t number, uint32_t wanted)
{
    if (kind == DEVICE) {
        answer(device, sizeof device, wanted);
    } else if (kind == CONFIGURATION && number == 0) {
        answer(configuration, sizeof configuration, wanted);
    } else if (kind == STRING) {
        answer_string(number, wanted);
    } else {
        refuse(); /* (full speed alone has no qualifier) */
    }
}

static void configure(bool on)
{
    configured = on;
    for (int i = 0; i < USB_LINES; i++) {
        begin(&lines[i], data_endpoint[i], false);
        begin(&lines[i], data_endpoint[i], true);
        lines[i].dtr = lines[i].dtr && on;
    }
}

/* The line whose data endpoint it is, or NULL. */
static line *line_of(uint32_t endpoint)
{
    for (int i = 0; i < USB_LINES; i++) {
        if (data_endpoint[i] == endpoint) {
            return &lines[i];
        }
    }
    return NULL;
}

/* Nothing here ever halts an endpoint; a host that clears a halt all the same begins its packets anew. */
static void clear_halt(uint32_t endpoint)
{
    line *l = line_of(endpoint & 0xf);
    if (l) {
        begin(l, endpoint & 0xf, !(endpoint & 0x80));
    }
    acknowledge();
}

static void hold_dtr(line *l, bool dtr)
{
    if (dtr && !l->dtr && l == &lines[USB_PUNCH]) {
        l->received.out = l->received.in; /* who opens it puts a new tape into the reader */
    }
    if (dtr != l->dtr) {
        l->turned = chip_micros();
    }
    l->dtr = dtr;
    acknowledge();
}

static void setup(void)
{
    uint8_t p[8];
    for (int i = 0; i < 8; i++) {
        p[i] = BYTES(0)[i];
    }
    uint32_t length = p[6] | (uint32_t)p[7] << 8;
    line *l = &lines[p[4] / 2 % USB_LINES];
    pid0 = DATA1;
    left = 0;
    takes_coding = NULL;
    new_address = 0;
    switch (p[0] << 8 | p[1]) {
    case 0x8006:
        answer_descriptor(p[3], p[2], length);
        break;
    case 0x0005: /* set address, when this is acknowledged */
        new_address = p[2];
        acknowledge();
        break;
    case 0x0009:
        configure(p[2] != 0);
        acknowledge();
        break;
    case 0x8008:
        answer_number(configured, 1, length);
        break;
    case 0x8000: /* status: of device, interface, endpoint; nothing to say */
    case 0x8100:
    case 0x8200:
        answer_number(0, 2, length);
        break;
    case 0x810a: /* get, set interface: there is one of each */
        answer_number(0, 1, length);
        break;
    case 0x010b:
        acknowledge();
        break;
    case 0x0201:
        clear_halt(p[4]);
        break;
    case 0xa121:
        answer(l->coding, sizeof l->coding, length);
        break;
    case 0x2120: /* set line coding: seven bytes follow */
        takes_coding = l;
        arm(0, 1, DATA1 | SIZE);
        break;
    case 0x2122:
        hold_dtr(l, p[2] & 1);
        break;
    case 0x2123: /* break: how long, ms; 0 ends one */
        broken = broken || (l == &lines[USB_TELETYPE] && (p[2] || p[3]));
        acknowledge();
        break;
    default:
        refuse();
    }
}

static void ep0_sent(void)
{
    if (new_address) {
        REG(ADDRESS) = new_address;
        new_address = 0;
    }
    if (left) {
        send_reply();
    } else if (reply) {
        reply = NULL;
        arm(0, 1, DATA1); /* the host acknowledges with an empty packet */
    }
}

static void ep0_heard(void)
{
    if (takes_coding) {
        for (uint32_t i = 0; i < sizeof takes_coding->coding; i++) {
            takes_coding->coding[i] = BYTES(EP0_BYTES)[i];
        }
        takes_coding = NULL;
        acknowledge();
    }
}

/* ---- the module's face ---- */

void usb_poll(void)
{
    uint32_t status = REG(SIE_STATUS), done = REG(BUFF_STATUS), now = REG(SOF);
    if (now != frame) {
        frame = now;
        frame_at = chip_micros();
    }
    if (status & (SUSPENDED | RESUMED)) {
        REG(SIE_STATUS) = SUSPENDED | RESUMED;
    }
    if (done) {
        REG(BUFF_STATUS) = done;
        if (done & 1) {
            ep0_sent();
        }
        if (done & 2) {
            ep0_heard();
        }
        for (int i = 0; i < USB_LINES; i++) {
            uint32_t bit = data_endpoint[i] * 2u;
            if (done & 1u << bit && lines[i].sending) {
                sent(&lines[i]);
            }
            if (done & 2u << bit && lines[i].listening) {
                hear(&lines[i], data_endpoint[i]);
            }
        }
    }
    if (status & BUS_RESET) { /* (behind the packets that came before it) */
        REG(SIE_STATUS) = BUS_RESET;
        REG(ADDRESS) = 0;
        new_address = 0;
        configure(false);
    }
    if (status & SETUP) {
        REG(SIE_STATUS) = SETUP;
        setup();
    }
    for (int i = 0; configured && i < USB_LINES; i++) {
        listen(&lines[i], data_endpoint[i]);
        send(&lines[i], data_endpoint[i]);
        shut(&lines[i], data_endpoint[i]);
    }
}

int usb_peek(usb_line number)
{
    const queue *q = &lines[number].received;
    return held(q) ? q->bytes[q->out % QUEUE] : USB_NONE;
}

int usb_take(usb_line number)
{
    int c = usb_peek(number);
    lines[number].received.out += c != USB_NONE;
    return c;
}

int usb_take_at_once(void)
{
    return held(&at_once) ? at_once.bytes[at_once.out++ % QUEUE] : USB_NONE;
}

void usb_drop(usb_line number)
{
    lines[number].received.out = lines[number].received.in;
}

bool usb_open(usb_line number)
{
    return lines[number].dtr;
}

bool usb_awake(void)
{
    return configured && chip_micros() - frame_at < AWAKE_MS * 1000u;
}

bool usb_room(usb_line number)
{
    return held(&lines[number].paper) < QUEUE;
}

void usb_put(usb_line number, uint8_t c)
{
    line *l = &lines[number];
    if (!usb_room(number)) {
        l->paper.out++;
        l->under_way -= l->under_way != 0;
        l->gap = true;
    }
    append(&l->paper, c);
}

bool usb_break(void)
{
    bool was = broken;
    broken = false;
    return was;
}

void usb_start(void)
{
    for (uint32_t i = 0; i < 0x1000; i += 4) {
        REG(MEMORY + i) = 0;
    }
    for (int i = 0; i < USB_LINES; i++) {
        lines[i].coding[1] = 0xc2; /* 115,200, 8 bits */
        lines[i].coding[2] = 1;
        lines[i].coding[6] = 8;
    }
    REG(MUXING) = TO_PHY | SOFTCON;
    REG(POWER) = VBUS | VBUS_OVERRIDE;
    REG(MAIN_CTRL) = ENABLE;
    REG(SIE_CTRL) = EP0_INTERRUPT;
    for (uint32_t endpoint = TTY_NOTICE; endpoint < ENDPOINTS; endpoint += 2) {
        CONTROL(endpoint, 0u) = EP_ENABLE | EP_INTERRUPT | INTERRUPT | BUFFER_OF(endpoint, 0u);
        CONTROL(endpoint + 1, 0u) = EP_ENABLE | EP_INTERRUPT | BULK | BUFFER_OF(endpoint + 1, 0u);
        CONTROL(endpoint + 1, 1u) = EP_ENABLE | EP_INTERRUPT | BULK | BUFFER_OF(endpoint + 1, 1u);
    }
    SET(SIE_CTRL) = PULLUP;
}
