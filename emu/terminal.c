/* The operator's keys and real time, on every system. See terminal.h. */
#include "terminal.h"

#include "complain.h"
#include "signs.h"

#include <string.h>

enum {
    CTRL_C = 0x03,
    BACKSPACE = 0x08,
    CTRL_Q = 0x11,
    CTRL_S = 0x13,
    CTRL_U = 0x15,
    CTRL_BACKSLASH = 0x1c,
    CTRL_BRACKET = 0x1d,
    CTRL_CARET = 0x1e,
    RUBOUT = 0x7f
};

/* A key, or a character from a pipe. */
static bool take_sign(terminal *t, board *b, uint8_t c)
{
    if (!t->keyboard) {
        bool crlf = t->after_cr && c == '\n';
        t->after_cr = c == '\r';
        if (crlf) {
            return true;
        }
        c = c == '\n' ? '\r' : c;
    }
    bool ends = c == '\r' || c == '\n', drops = c == CTRL_U || c == CTRL_C;
    bool is_lost = t->dropped && !drops; /* (the board has taken back its part of the line) */
    t->row += ends;
    t->dropped &= !ends && !drops;
    t->column = ends || drops                   ? 0
                : c == BACKSPACE || c == RUBOUT ? t->column - (t->column > 0)
                                                : t->column + (c >= ' ');
    if (t->keyboard) {
        switch (c) {
        case CTRL_BRACKET:
            if (t->leaves) {
                t->ended = t->left = true;
                return true;
            }
            break;
        case CTRL_BACKSLASH:
            if (t->leaves) {
                board_forget_typed(b);
                t->reset = true;
                t->dropped = false;
                t->column = 0;
                return true;
            }
            break;
        case CTRL_CARET:
            if (t->stops) {
                t->stop = true;
                return true;
            }
            break;
        case CTRL_C:
            board_forget_typed(b);
            return board_press(b, c);
        case CTRL_Q:
        case CTRL_S:
            return board_press(b, c);
        }
    }
    return is_lost || board_type(b, &c, 1);
}

/* A character without an ASCII sign: drops its line, and reports the first one of a line. */
static bool drop_line(terminal *t, board *b, size_t used)
{
    static const uint8_t take_back = CTRL_U;
    char shown[SIGNS_SHOWN];
    if (t->dropped) {
        return true;
    }
    signs_show(t->character, used, shown);
    if (t->keyboard) {
        remark("column %u: %s is not ASCII: the line is dropped, RETURN begins another", t->column + 1, shown);
    } else {
        remark("standard input: line %u, column %u: %s is not ASCII: the line is dropped", t->row + 1, t->column + 1,
               shown);
    }
    bool begun = t->column > 0;
    t->dropped = t->refused = true;
    return !begun || board_type(b, &take_back, 1);
}

bool terminal_take(terminal *t, board *b, uint8_t c)
{
    t->character[t->character_length++] = c;
    while (t->character_length && !t->left) {
        size_t used;
        int sign = signs_read(t->character, t->character_length, &used);
        if (sign == SIGNS_MORE) {
            return true;
        }
        if (sign == SIGNS_STRANGE ? !drop_line(t, b, used) : !take_sign(t, b, (uint8_t)sign)) {
            return false;
        }
        t->character_length -= used;
        memmove(t->character, t->character + used, t->character_length);
    }
    return true;
}

void pacer_start(pacer *p, double hz, uint64_t cycles)
{
    p->hz = hz;
    p->start_cycles = cycles;
    p->start = terminal_now();
}

void pacer_wait(const pacer *p, uint64_t cycles)
{
    if (p->hz > 0) {
        double early = p->start + (double)(cycles - p->start_cycles) / p->hz - terminal_now();
        if (early > 0) {
            terminal_sleep(early);
        }
    }
}
