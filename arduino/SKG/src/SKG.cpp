/* The SKG board for an Arduino. See SKG.h. */
#include "SKG.h"

#include <string.h>

enum { CTRL_C = 3, CTRL_Q = 17, CTRL_S = 19 };

const small_board_lines SkgBoard::lines = { key, may, print, read, may, punch, drive_in, drive_out };

SkgBoard::SkgBoard(Stream &teletype, Stream *tape, uint8_t *ram, size_t ram_size, const uint8_t *rom)
    : teletype_(teletype), tape_(tape), ram_(ram), ram_size_(ram_size), rom_(rom)
{
}

void SkgBoard::onDrive(void (*out)(uint8_t latch), uint8_t (*in)())
{
    out_ = out;
    in_ = in;
}

void SkgBoard::begin()
{
    memset(ram_, 0, ram_size_);
    small_board_init(&board_, rom_, ram_, ram_size_, &lines, this);
    first_ = count_ = 0;
    at_once_ = SMALL_BOARD_NONE;
}

void SkgBoard::reset()
{
    first_ = count_ = 0;
    at_once_ = SMALL_BOARD_NONE;
    small_board_reset(&board_);
}

void SkgBoard::run(uint32_t cycles)
{
    small_board_run(&board_, cycles);
}

/* Takes what has been typed out of the stream, as far as there is room: what is left there holds the sender. */
void SkgBoard::listen()
{
    while (at_once_ == SMALL_BOARD_NONE && count_ < KEYS && teletype_.available() > 0) {
        int c = teletype_.read();
        if (c < 0) {
            return;
        }
        if (c == CTRL_C || c == CTRL_S || c == CTRL_Q) {
            at_once_ = c;
            count_ = c == CTRL_C ? 0 : count_;
        } else {
            keys_[(first_ + count_++) % KEYS] = (uint8_t)c;
        }
    }
}

int SkgBoard::key(void *user, bool waits)
{
    SkgBoard *b = (SkgBoard *)user;
    b->listen();
    int c = b->at_once_;
    b->at_once_ = SMALL_BOARD_NONE;
    if (c == SMALL_BOARD_NONE && waits && b->count_) {
        c = b->keys_[b->first_];
        b->first_ = (b->first_ + 1) % KEYS;
        b->count_--;
    }
    return c;
}

/* write() waits where there is no room. */
bool SkgBoard::may(void *user)
{
    (void)user;
    return true;
}

void SkgBoard::print(void *user, uint8_t c)
{
    ((SkgBoard *)user)->teletype_.write(c);
}

/* A reader that is silent costs the ROM the time that it would at 2 MHz: it counts its questions. */
int SkgBoard::read(void *user)
{
    SkgBoard *b = (SkgBoard *)user;
    int c = b->tape_ && b->tape_->available() > 0 ? b->tape_->read() : SMALL_BOARD_NONE;
    uint32_t cycles = (uint32_t)(b->board_.cpu.cycles - b->asked_);
    if (c < 0 && small_board_waits_for_reader(&b->board_)) {
        while (micros() - b->asked_at_ < cycles / 2) {
            yield();
        }
    }
    b->asked_ = b->board_.cpu.cycles;
    b->asked_at_ = micros();
    return c < 0 ? SMALL_BOARD_NONE : c;
}

void SkgBoard::punch(void *user, uint8_t c)
{
    SkgBoard *b = (SkgBoard *)user;
    if (b->tape_) {
        b->tape_->write(c);
    }
}

uint8_t SkgBoard::drive_in(void *user)
{
    SkgBoard *b = (SkgBoard *)user;
    yield();
    return b->in_ ? b->in_() : 0;
}

void SkgBoard::drive_out(void *user, uint8_t latch)
{
    SkgBoard *b = (SkgBoard *)user;
    if (b->out_) {
        b->out_(latch);
    }
}
