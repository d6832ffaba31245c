/* The operator's side of the teletype on Linux, macOS and their like. See terminal.h. */
#include "terminal.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <time.h>
#include <unistd.h>

enum { DEAF_AFTER = 1000 };         /* ms that a full teletype may keep the board waiting */

/* ---- standard streams ---- */

/* A file opened later must not get the number of a closed standard stream. So a closed input or output becomes one that
 * fails, a closed standard error one that is silent. */
bool terminal_open_streams(void)
{
    static const int wrong_way[] = { O_WRONLY, O_RDONLY, O_WRONLY };
    for (int fd = STDIN_FILENO; fd <= STDERR_FILENO; fd++) {
        if (fcntl(fd, F_GETFD) < 0 && open("/dev/null", wrong_way[fd]) < 0) {
            return false;
        }
    }
    return true;
}

/* ---- raw mode ---- */

/* Global, for the signal handler. */
static struct termios cooked, raw;
static volatile sig_atomic_t is_raw;

static void set_raw(void)
{
    if (tcsetattr(STDIN_FILENO, TCSADRAIN, &raw) == 0) {
        is_raw = 1;
    }
}

static void set_cooked(void)
{
    if (is_raw) {
        tcsetattr(STDIN_FILENO, TCSANOW, &cooked);
        is_raw = 0;
    }
}

/* Restores the terminal, then lets the signal take its default effect. */
static void on_fatal(int number)
{
    set_cooked();
    signal(number, SIG_DFL);
    raise(number);
}

static void on_stop(int number)
{
    int saved = errno;
    (void)number;
    set_cooked();
    raise(SIGSTOP);
    errno = saved;
}

static void on_continue(int number)
{
    int saved = errno;
    (void)number;
    set_raw();
    errno = saved;
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

/* ---- the reset button ---- */

/* The signal handler writes into one end of a pipe; every wait for keys also waits at the other end. */
static int reset_pipe[2] = { -1, -1 };

static void on_reset(int number)
{
    int saved = errno;
    (void)number;
    if (write(reset_pipe[1], "", 1) < 0) {
        /* full: a reset is under way */
    }
    errno = saved;
}

void terminal_catch_reset(void)
{
    struct sigaction action;
    memset(&action, 0, sizeof action);
    action.sa_handler = on_reset;
    action.sa_flags = SA_RESTART;
    if (pipe(reset_pipe) == 0) {
        fcntl(reset_pipe[0], F_SETFL, O_NONBLOCK);
        fcntl(reset_pipe[1], F_SETFL, O_NONBLOCK);
        sigaction(SIGUSR1, &action, NULL);
    }
}

/* ---- signals ---- */

void terminal_catch_interrupt(void (*called)(int))
{
    struct sigaction action;
    memset(&action, 0, sizeof action);
    action.sa_handler = called;
    sigaction(SIGINT, &action, NULL);
}

static void catch_signals(void)
{
    static const int fatal[] = {
        // clang-format off
        SIGABRT, SIGALRM, SIGBUS, SIGFPE, SIGHUP, SIGILL, SIGINT, SIGPIPE, SIGPROF, SIGQUIT, SIGSEGV,
        SIGSYS, SIGTERM, SIGTRAP, SIGUSR2, SIGVTALRM, SIGXCPU, SIGXFSZ,
        // clang-format on
    };
    struct sigaction action;
    memset(&action, 0, sizeof action);
    sigfillset(&action.sa_mask);
    action.sa_handler = on_fatal;
    action.sa_flags = SA_NODEFER;
    for (size_t i = 0; i < sizeof fatal / sizeof *fatal; i++) {
        struct sigaction old;
        if (sigaction(fatal[i], NULL, &old) == 0 && old.sa_handler == SIG_DFL) {
            sigdelset(&action.sa_mask, fatal[i]);
            sigaction(fatal[i], &action, NULL);
            sigaddset(&action.sa_mask, fatal[i]);
        }
    }
    action.sa_flags = SA_RESTART;
    action.sa_handler = on_stop;
    sigaction(SIGTSTP, &action, NULL);
    action.sa_handler = on_continue;
    sigaction(SIGCONT, &action, NULL);
}

void terminal_open(terminal *t)
{
    memset(t, 0, sizeof *t);
    t->in = STDIN_FILENO;
    t->out = STDOUT_FILENO;
    if (tcgetattr(STDIN_FILENO, &cooked) != 0) {
        return;
    }
    t->keyboard = t->leaves = true;
    raw = cooked;
    cfmakeraw(&raw);
    raw.c_cc[VMIN] = 1;
    raw.c_cc[VTIME] = 0;
    catch_signals();
    atexit(set_cooked);
    set_raw();
}

int terminal_open_pty(terminal *t)
{
    memset(t, 0, sizeof *t);
    t->keyboard = true;
    t->patience = DEAF_AFTER;
    t->in = t->out = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
    if (t->in < 0 || grantpt(t->in) || unlockpt(t->in)) {
        return -1;
    }
    const char *name = ptsname(t->in);
    if (!name || strlen(name) >= sizeof t->name) {
        return -1;
    }
    strcpy(t->name, name);
    /* Keep one descriptor of the user's end open: the line then stays, and stays raw, when its user hangs up. */
    t->line = open(name, O_RDWR | O_NOCTTY | O_CLOEXEC);
    struct termios settings;
    if (t->line < 0 || tcgetattr(t->line, &settings)) {
        return -1;
    }
    cfmakeraw(&settings);
    if (tcsetattr(t->line, TCSANOW, &settings)) {
        return -1;
    }
    return fcntl(t->in, F_SETFL, fcntl(t->in, F_GETFL) | O_NONBLOCK);
}

/* ---- characters ---- */

void terminal_print(terminal *t, uint8_t c)
{
    if (t->copy) {
        putc(c, t->copy);
    }
    while (write(t->out, &c, 1) != 1) {
        struct pollfd line = { .fd = t->out, .events = POLLOUT };
        if (errno == EINTR) {
            continue;
        }
        if (errno != EAGAIN && !*t->name) {
            t->failed = errno;
            return;
        }
        if (errno != EAGAIN || t->deaf) {
            return; /* a teletype that is switched off prints nothing */
        }
        if (poll(&line, 1, *t->name ? t->patience : -1) == 0) {
            t->deaf = true;
            return;
        }
    }
    t->deaf = false;
}

bool terminal_listen(terminal *t, board *b, int milliseconds)
{
    struct pollfd lines[] = { { .fd = reset_pipe[0], .events = POLLIN }, { .fd = t->in, .events = POLLIN } };
    uint8_t bytes[1024];
    if (poll(lines, t->ended ? 1 : 2, t->ended ? 0 : milliseconds) <= 0) {
        return true;
    }
    if (lines[0].revents && read(reset_pipe[0], bytes, sizeof bytes) > 0) {
        if (t->keyboard) {
            board_forget_typed(b);
        }
        t->reset = true;
    }
    if (t->ended || !lines[1].revents) {
        return true;
    }
    ssize_t count = read(t->in, bytes, sizeof bytes);
    if (count == 0 || (count < 0 && errno != EINTR && errno != EAGAIN)) {
        t->ended = true;
    }
    for (ssize_t i = 0; i < count && !t->left; i++) {
        if (!terminal_take(t, b, bytes[i])) {
            return false;
        }
    }
    return true;
}

bool terminal_feed(terminal *t, board *b, int milliseconds)
{
    struct pollfd line = { .fd = t->in, .events = POLLIN };
    uint8_t bytes[4096]; /* a line holds no more */
    if (poll(&line, 1, milliseconds) <= 0) {
        return true;
    }
    ssize_t count = read(t->in, bytes, sizeof bytes);
    return count <= 0 || board_tape(b, bytes, (size_t)count);
}

void terminal_drain(terminal *t)
{
    /* Written characters take a while to show up as unread: the line must be seen empty several times. */
    enum { STEP_MS = 5, TIMES_EMPTY = 10 };
    int unread = 0;
    for (int ms = 0, empty = 0; empty < TIMES_EMPTY; ms += STEP_MS) {
        if (ioctl(t->line, FIONREAD, &unread) || ms >= t->patience) {
            t->deaf = true;
            return;
        }
        empty = unread ? 0 : empty + 1;
        terminal_sleep(STEP_MS / 1000.0);
    }
}

/* ---- time ---- */

double terminal_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + (double)now.tv_nsec / 1e9;
}

void terminal_sleep(double seconds)
{
    struct timespec rest = { .tv_sec = (time_t)seconds };
    rest.tv_nsec = (long)((seconds - (double)rest.tv_sec) * 1e9);
    while (nanosleep(&rest, &rest) && errno == EINTR) {
    }
}
