/* The operator's side of the teletype on Windows. See terminal.h.
 *
 * A console is read event by event, and shows what a terminal would. Windows has no pseudo-terminals that a program
 * could offer to others, and no signal for the reset button.
 */
#include "terminal.h"

#include <errno.h>
#include <fcntl.h>
#include <io.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <windows.h>

#ifndef ENABLE_VIRTUAL_TERMINAL_PROCESSING
#define ENABLE_VIRTUAL_TERMINAL_PROCESSING 0x0004
#endif

/* ---- standard streams ---- */

bool terminal_open_streams(void)
{
    _fmode = _O_BINARY;
    for (int fd = 0; fd <= 2; fd++) {
        if (_get_osfhandle(fd) < 0 && _open("NUL", fd ? _O_RDONLY : _O_WRONLY) < 0) {
            return false;
        }
        _setmode(fd, _O_BINARY);
    }
    return true;
}

/* ---- raw mode ---- */

/* The console's former modes, and whether there is one at either end. */
static struct {
    HANDLE handle;
    DWORD cooked;
    bool is_console;
} input, output;
static volatile bool is_raw;

static void set_raw(void)
{
    DWORD lines = ENABLE_LINE_INPUT | ENABLE_ECHO_INPUT | ENABLE_PROCESSED_INPUT;
    is_raw = input.is_console && SetConsoleMode(input.handle, input.cooked & ~lines);
}

static void set_cooked(void)
{
    if (is_raw) {
        SetConsoleMode(input.handle, input.cooked);
        is_raw = false;
    }
}

static void restore(void)
{
    set_cooked();
    if (output.is_console) {
        SetConsoleMode(output.handle, output.cooked);
    }
}

/* Restores the console when the window closes, or at ctrl-break. */
static BOOL WINAPI on_end(DWORD event)
{
    (void)event;
    restore();
    return FALSE;
}

bool terminal_pause(void)
{
    bool was = is_raw;
    set_cooked();
    return was;
}

void terminal_resume(void)
{
    set_raw();
}

bool terminal_is_raw(void)
{
    return is_raw;
}

void terminal_open(terminal *t)
{
    memset(t, 0, sizeof *t);
    t->in = 0;
    t->out = 1;
    input.handle = GetStdHandle(STD_INPUT_HANDLE);
    output.handle = GetStdHandle(STD_OUTPUT_HANDLE);
    input.is_console = GetConsoleMode(input.handle, &input.cooked);
    output.is_console = GetConsoleMode(output.handle, &output.cooked);
    if (output.is_console) {
        SetConsoleMode(output.handle, output.cooked | ENABLE_VIRTUAL_TERMINAL_PROCESSING);
    }
    t->keyboard = t->leaves = input.is_console;
    atexit(restore);
    SetConsoleCtrlHandler(on_end, TRUE);
    set_raw();
}

/* ---- missing on Windows ---- */

int terminal_open_pty(terminal *t)
{
    memset(t, 0, sizeof *t);
    errno = ENOSYS;
    return -1;
}

void terminal_catch_reset(void)
{
}

bool terminal_feed(terminal *t, board *b, int milliseconds)
{
    (void)t, (void)b, (void)milliseconds;
    return true;
}

void terminal_drain(terminal *t)
{
    (void)t;
}

/* ---- characters ---- */

static void (*on_interrupt)(int);

/* (a signal goes back to its default when it has come) */
static void interrupted(int number)
{
    signal(SIGINT, interrupted);
    on_interrupt(number);
}

void terminal_catch_interrupt(void (*called)(int))
{
    on_interrupt = called;
    signal(SIGINT, interrupted);
}

void terminal_print(terminal *t, uint8_t c)
{
    if (t->copy) {
        putc(c, t->copy);
    }
    if (_write(t->out, &c, 1) != 1) {
        t->failed = errno;
    }
}

/* Gives the board a key, a unit of UTF-16, in UTF-8. (A half of a pair becomes three bytes that are none.) */
static bool take_key(terminal *t, board *b, WCHAR key)
{
    if (key < 0x80) {
        return terminal_take(t, b, (uint8_t)key);
    }
    if (key < 0x800) {
        return terminal_take(t, b, (uint8_t)(0xc0 | key >> 6)) && terminal_take(t, b, (uint8_t)(0x80 | (key & 0x3f)));
    }
    return terminal_take(t, b, (uint8_t)(0xe0 | key >> 12)) && terminal_take(t, b, (uint8_t)(0x80 | (key >> 6 & 0x3f)))
           && terminal_take(t, b, (uint8_t)(0x80 | (key & 0x3f)));
}

/* Gives the board the keys that wait at the console, after waiting for one. */
static bool listen_to_console(terminal *t, board *b, DWORD milliseconds)
{
    INPUT_RECORD events[64];
    DWORD count = 0;
    if (WaitForSingleObject(input.handle, milliseconds) != WAIT_OBJECT_0) {
        return true;
    }
    if (!ReadConsoleInputW(input.handle, events, sizeof events / sizeof *events, &count)) {
        t->ended = true;
    }
    for (DWORD i = 0; i < count; i++) {
        const KEY_EVENT_RECORD *key = &events[i].Event.KeyEvent;
        bool is_typed = events[i].EventType == KEY_EVENT && key->bKeyDown && key->uChar.UnicodeChar;
        for (WORD n = 0; is_typed && n < key->wRepeatCount && !t->left; n++) {
            if (!take_key(t, b, key->uChar.UnicodeChar)) {
                return false;
            }
        }
    }
    return true;
}

/* Waits for a byte in a pipe, or its end; a file always has one or the other. */
static bool is_ready(int milliseconds)
{
    if (milliseconds < 0 || GetFileType(input.handle) != FILE_TYPE_PIPE) {
        return true;
    }
    for (;; milliseconds--) {
        DWORD waiting = 0;
        if (!PeekNamedPipe(input.handle, NULL, 0, NULL, &waiting, NULL) || waiting) {
            return true;
        }
        if (milliseconds <= 0) {
            return false;
        }
        Sleep(1);
    }
}

bool terminal_listen(terminal *t, board *b, int milliseconds)
{
    uint8_t bytes[1024];
    if (t->ended) {
        return true;
    }
    if (t->keyboard) {
        return listen_to_console(t, b, milliseconds < 0 ? INFINITE : (DWORD)milliseconds);
    }
    if (!is_ready(milliseconds)) {
        return true;
    }
    int count = _read(t->in, bytes, sizeof bytes);
    t->ended = count <= 0;
    for (int i = 0; i < count; i++) {
        if (!terminal_take(t, b, bytes[i])) {
            return false;
        }
    }
    return true;
}

/* ---- time ---- */

double terminal_now(void)
{
    LARGE_INTEGER ticks, second;
    QueryPerformanceCounter(&ticks);
    QueryPerformanceFrequency(&second);
    return (double)ticks.QuadPart / (double)second.QuadPart;
}

void terminal_sleep(double seconds)
{
    Sleep((DWORD)(seconds * 1000));
}
