/* The operator's keys and real time, on every system. See terminal.h. */
#include "terminal.h"

enum { CTRL_C = 0x03, CTRL_Q = 0x11, CTRL_S = 0x13, CTRL_BACKSLASH = 0x1c, CTRL_BRACKET = 0x1d, CTRL_CARET = 0x1e };

bool terminal_take(terminal *t, board *b, uint8_t c)
{
    if (!t->keyboard) {
        bool crlf = t->after_cr && c == '\n';
        t->after_cr = c == '\r';
        if (crlf) {
            return true;
        }
        c = c == '\n' ? '\r' : c;
        return board_type(b, &c, 1);
    }
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
    return board_type(b, &c, 1);
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
