/* The SKG board on a Raspberry Pi Pico: two serial lines over USB, two motors, programs that survive power off
 *
 *      teletype        the first USB line; a break there, or BOOTSEL held for a second, is the reset button
 *      punch, reader   the second one; while no program holds it open, what is punched goes nowhere
 *      port 14H        pins (motors.h)
 *
 * A line that begins with # at the prompt is not the ROM's but this program's (panel()): feed and ROM.
 *
 * What a board's memory holds is kept in the flash a second after the prompt has come and nobody has typed, if it is not what
 * is kept already: all of it, with the processor's registers, so a board that has come back does not know that it was
 * away. It is kept at the prompt alone, where no line is half stored; each ROM has copies of its own.
 *
 * NOT IMPLEMENTED: the 8080's pace (it goes as fast as it can, some 16 MHz), but for the two seconds after which LOAD gives
 * up a reader that is silent.
 */
#include "chip.h"
#include "motors.h"
#include "small_board.h"
#include "store.h"
#include "usb.h"

#include <string.h>

enum { RAM_SIZE = 0xe000, SLICE_CYCLES = 2000, RAM_PAGES = RAM_SIZE / FLASH_PAGE };
enum { KEEP_AFTER_US = 1000000, PRESS_US = 1000000, LOOK_US = 50000 };
enum { CR = 13, LF = 10, CTRL_C = 3, CTRL_U = 21, BACKSPACE = 8, RUBOUT = 127, BLANK = ' ' };

/* ---- the ROMs, which stay in flash until one is chosen ---- */

#define ROM_IN_FLASH(name, file)                                                  \
    __asm__(".section .roms, \"a\"\n" #name ": .incbin \"" file "\"\n.previous"); \
    extern const uint8_t name[SMALL_BOARD_ROM]

ROM_IN_FLASH(rom_skg, "roms/skg.bin");
ROM_IN_FLASH(rom_drive, "roms/skg-drive.bin");
ROM_IN_FLASH(rom_mill, "roms/skg-mill.bin");

static const struct {
    const char *name;
    const uint8_t *bytes;
} roms[] = { { "SKG", rom_skg }, { "DRIVE", rom_drive }, { "MILL", rom_mill } };

enum { ROMS = sizeof roms / sizeof *roms, SETTINGS_SHELF = ROMS };

_Static_assert((int)SETTINGS_SHELF < (int)STORE_SHELVES, "a shelf for each ROM, and one for the settings");

/* ---- all there is ---- */

typedef struct {
    uint32_t rom, feed; /* rom: a row of roms[] */
} settings;

static settings set = { .rom = 0, .feed = 1000 };
static uint32_t rom_wanted; /* what the panel was told: it is put in when the processor stands still */

static uint8_t rom[SMALL_BOARD_ROM], ram[RAM_SIZE];
static small_board board;
/* 8080 cycles and instructions since the board began, for who looks into the chip: at the beginning of RAM. */
volatile uint64_t counts[2] __attribute__((section(".counts"), used));

/* ---- text on the paper ---- */

static void print(const char *text)
{
    for (; *text; text++) {
        usb_put(USB_TELETYPE, (uint8_t)*text);
    }
}

static void print_number(uint32_t number)
{
    char digits[11];
    int at = sizeof digits - 1;
    digits[at] = 0;
    do {
        digits[--at] = (char)('0' + number % 10);
        number /= 10;
    } while (number);
    print(&digits[at]);
}

/* ---- what is kept ---- */

/* Of a board, beside the pages of its memory that are not all zero. */
typedef struct {
    uint32_t rom_sum;
    uint16_t bc, de, hl, sp, pc;
    uint8_t a, f, inte, latch, holds;
    uint8_t full[RAM_PAGES / 8]; /* a bit for each page: it is there */
} board_about;

_Static_assert(sizeof(board_about) <= STORE_ABOUT && (int)RAM_PAGES <= (int)STORE_PAGES, "a copy's room");

static uint32_t kept_sum;   /* of the memory as it is kept */
static bool looked;         /* the memory has been looked at since this prompt came */
static uint32_t quiet_since;

static bool is_zero(const uint8_t *page)
{
    for (uint32_t i = 0; i < FLASH_PAGE; i++) {
        if (page[i]) {
            return false;
        }
    }
    return true;
}

static void keep_board(void)
{
    static const uint8_t *pages[RAM_PAGES];
    uint8_t about[STORE_ABOUT] = { 0 };
    const i8080_small *cpu = &board.cpu;
    board_about now = { .rom_sum = store_sum(0, rom, sizeof rom),
                        .bc = cpu->bc,
                        .de = cpu->de,
                        .hl = cpu->hl,
                        .sp = cpu->sp,
                        .pc = cpu->pc,
                        .a = cpu->a,
                        .f = cpu->f,
                        .inte = cpu->inte,
                        .latch = board.latch,
                        .holds = board.holds };
    uint32_t count = 0;
    for (uint32_t page = 0; page < RAM_PAGES; page++) {
        if (!is_zero(&ram[page * FLASH_PAGE])) {
            now.full[page / 8] |= (uint8_t)(1 << page % 8);
            pages[count++] = &ram[page * FLASH_PAGE];
        }
    }
    memcpy(about, &now, sizeof now);
    store_keep(set.rom, about, pages, count);
}

/* The board as it was when power went; false: nothing is kept that this ROM could go on with. */
static bool bring_back(void)
{
    bool torn;
    board_about was;
    const store_copy *copy = store_newest(set.rom, &torn);
    if (!copy) {
        return false;
    }
    memcpy(&was, copy->about, sizeof was);
    if (was.rom_sum != store_sum(0, rom, sizeof rom)) {
        print("\r\nTHE KEPT PROGRAM IS OF ANOTHER VERSION: NOT LOADED\r\n");
        return false;
    }
    const uint8_t *from = (const uint8_t *)(copy + 1);
    for (uint32_t page = 0; page < RAM_PAGES; page++) {
        if (was.full[page / 8] >> page % 8 & 1) {
            memcpy(&ram[page * FLASH_PAGE], from, FLASH_PAGE);
            from += FLASH_PAGE;
        }
    }
    i8080_small *cpu = &board.cpu;
    cpu->bc = was.bc;
    cpu->de = was.de;
    cpu->hl = was.hl;
    cpu->sp = was.sp;
    cpu->pc = was.pc;
    cpu->a = was.a;
    cpu->f = was.f;
    cpu->inte = was.inte;
    board.latch = was.latch;
    board.holds = was.holds;
    kept_sum = store_sum(0, ram, sizeof ram);
    print(torn ? "\r\nSKG KEPT, WITHOUT THE LAST CHANGE\r\n>" : "\r\nSKG KEPT\r\n>");
    small_board_prompted(&board);
    return true;
}

/* Keeps the board when it is at the prompt, nobody has typed for a second, and something has changed. */
static void keep_when_quiet(void)
{
    if (!small_board_at_prompt(&board) || usb_peek(USB_TELETYPE) != USB_NONE) {
        looked = false;
        quiet_since = chip_micros();
    } else if (!looked && chip_micros() - quiet_since >= KEEP_AFTER_US) {
        uint32_t sum = store_sum(0, ram, sizeof ram);
        looked = true;
        if (sum != kept_sum) {
            keep_board();
            kept_sum = sum;
        }
    }
}

static void keep_settings(void)
{
    uint8_t about[STORE_ABOUT] = { 0 };
    memcpy(about, &set, sizeof set);
    store_keep(SETTINGS_SHELF, about, NULL, 0);
}

static void load_settings(void)
{
    bool torn;
    const store_copy *copy = store_newest(SETTINGS_SHELF, &torn);
    if (copy) {
        settings was;
        memcpy(&was, copy->about, sizeof was);
        set.feed = was.feed;
        set.rom = was.rom < ROMS ? was.rom : set.rom;
    }
}

/* ---- the panel ---- */

/* The part that has been typed of a line with # in front, without the #. */
static char typed[32];
static int typed_length = -1; /* -1: no such line */

/* True when `line` begins with this word; it is then what stands behind it and the blanks there. */
static bool is_word(const char **line, const char *word)
{
    const char *l = *line;
    for (; *word; word++, l++) {
        if (*word != *l) {
            return false;
        }
    }
    if (*l && *l != BLANK) {
        return false;
    }
    while (*l == BLANK) {
        l++;
    }
    *line = l;
    return true;
}

/* A number up to `most`, and nothing behind it; -1: none. */
static int32_t number_of(const char *text, int32_t most)
{
    int32_t number = *text ? 0 : -1;
    for (; *text; text++) {
        if (*text < '0' || *text > '9' || (number = number * 10 + *text - '0') > most) {
            return -1;
        }
    }
    return number;
}

static bool set_feed(const char *text)
{
    int32_t feed = is_word(&text, "PIN") && !*text ? FEED_PIN : number_of(text, FEED_MOST);
    if (feed < 0) {
        return false;
    }
    set.feed = (uint32_t)feed;
    motors_feed(set.feed);
    keep_settings();
    return true;
}

static bool set_rom(const char *text)
{
    for (uint32_t i = 0; i < ROMS; i++) {
        const char *rest = text;
        if (is_word(&rest, roms[i].name) && !*rest) {
            rom_wanted = i;
            return true;
        }
    }
    return false;
}

static void show_settings(void)
{
    print("#FEED ");
    if (set.feed == FEED_PIN) {
        print("PIN");
    } else {
        print_number(set.feed);
    }
    print("\r\n#ROM ");
    print(roms[set.rom].name);
    print("\r\n");
}

/* Carries out a line: nothing shows what is set, FEED n and FEED PIN, ROM name. */
static void carry_out(const char *line)
{
    print("\r\n");
    if (!*line) {
        show_settings();
    } else if (!(is_word(&line, "FEED") ? set_feed(line) : is_word(&line, "ROM") && set_rom(line))) {
        print("# FEED 0 TO 50000, FEED PIN, ROM SKG, ROM DRIVE, ROM MILL\r\n");
    }
    if (set.rom == rom_wanted) {
        print(">");
    }
}

static void type_to_panel(uint8_t c)
{
    if (c == CR || c == LF) {
        typed[typed_length] = 0;
        typed_length = -1;
        carry_out(typed);
    } else if (c == CTRL_U) {
        typed_length = -1;
        print("\r\n>");
    } else if ((c == BACKSPACE || c == RUBOUT) && typed_length >= 0) {
        typed_length--;
        print("\b \b");
    } else if (c >= BLANK && typed_length < (int)sizeof typed - 1) {
        usb_put(USB_TELETYPE, c);
        typed[typed_length++] = (char)(c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c);
    }
}

/* ---- the board's lines ---- */

static int key(void *user, bool waits)
{
    (void)user;
    usb_poll();
    int c = usb_take_at_once();
    if (typed_length >= 0 && c == CTRL_C) {
        type_to_panel(CTRL_U);
        return SMALL_BOARD_NONE;
    }
    if (c != USB_NONE || !waits) {
        return c;
    }
    if (typed_length < 0 && usb_peek(USB_TELETYPE) == '#' && small_board_at_prompt(&board)) {
        usb_put(USB_TELETYPE, (uint8_t)usb_take(USB_TELETYPE));
        typed_length = 0;
    }
    while (typed_length >= 0 && (c = usb_take(USB_TELETYPE)) != USB_NONE) {
        type_to_panel((uint8_t)c);
    }
    return typed_length < 0 ? usb_take(USB_TELETYPE) : SMALL_BOARD_NONE;
}

/* Without a reader the paper goes on. */
static bool may_print(void *user)
{
    (void)user;
    return usb_room(USB_TELETYPE) || !usb_open(USB_TELETYPE) || !usb_awake();
}

static void print_character(void *user, uint8_t c)
{
    (void)user;
    usb_put(USB_TELETYPE, c);
}

/* A reader that is silent costs the ROM the cycles that it would at 2 MHz: it counts its questions. */
static void wait_as_2_mhz(void)
{
    static uint64_t asked;
    static uint32_t asked_at;
    uint32_t cycles = (uint32_t)(board.cpu.cycles - asked);
    if (small_board_waits_for_reader(&board)) {
        while (chip_micros() - asked_at < cycles / 2) {
            usb_poll();
        }
    }
    asked = board.cpu.cycles;
    asked_at = chip_micros();
}

static int reader(void *user)
{
    (void)user;
    usb_poll();
    int c = usb_take(USB_PUNCH);
    if (c == USB_NONE) {
        wait_as_2_mhz();
    }
    return c;
}

static bool may_punch(void *user)
{
    (void)user;
    return usb_room(USB_PUNCH) || !usb_open(USB_PUNCH);
}

static void punch(void *user, uint8_t c)
{
    (void)user;
    if (usb_open(USB_PUNCH)) {
        usb_put(USB_PUNCH, c);
    }
}

static uint8_t drive_in(void *user)
{
    (void)user;
    return motors_in();
}

static void drive_out(void *user, uint8_t latch)
{
    (void)user;
    motors_out(latch, usb_poll);
}

static const small_board_lines lines = {
    key, may_print, print_character, reader, may_punch, punch, drive_in, drive_out
};

/* ---- power on, reset ---- */

static void begin_board(void)
{
    memcpy(rom, roms[set.rom].bytes, sizeof rom);
    memset(ram, 0, sizeof ram);
    small_board_init(&board, rom, ram, sizeof ram, &lines, NULL);
    kept_sum = 0;
    bring_back();
}

/* Another ROM, with its own program. */
static void change_rom(void)
{
    if (store_sum(0, ram, sizeof ram) != kept_sum) {
        keep_board();
    }
    set.rom = rom_wanted;
    keep_settings();
    begin_board();
}

static void press_reset(void)
{
    usb_drop(USB_TELETYPE);
    usb_drop(USB_PUNCH);
    typed_length = -1;
    small_board_reset(&board);
}

/* True when BOOTSEL has been held for a second; once for each time. */
static bool held_bootsel(void)
{
    static uint32_t looked_at, pressed_at;
    static bool pressed, done;
    uint32_t now = chip_micros();
    if (now - looked_at < LOOK_US) {
        return false;
    }
    looked_at = now;
    bool is = chip_bootsel();
    pressed_at = pressed ? pressed_at : now;
    pressed = is;
    done = done && is;
    if (!is || done || now - pressed_at < PRESS_US) {
        return false;
    }
    done = true;
    return true;
}

int main(void)
{
    chip_start();
    load_settings();
    rom_wanted = set.rom;
    motors_start();
    motors_feed(set.feed);
    usb_start();
    begin_board();
    for (;;) {
        small_board_run(&board, SLICE_CYCLES);
        usb_poll();
        if (usb_break() || held_bootsel()) {
            press_reset();
        }
        if (rom_wanted != set.rom) {
            change_rom();
        }
        keep_when_quiet();
        counts[0] = board.cpu.cycles;
        counts[1] = board.cpu.instructions;
    }
}
