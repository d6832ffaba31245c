/* Messages of skg80. See complain.h. */
#include "complain.h"

#include "terminal.h"

#include <stdarg.h>
#include <stdio.h>

static const board *open_line;

void complain_beside(const board *b)
{
    open_line = b;
}

void complain_end_line(void)
{
    if (open_line && open_line->line_length) {
        fputs("\r\n", stderr);
    }
}

static void say(const char *format, va_list arguments)
{
    complain_end_line();
    fputs("skg80: ", stderr);
    vfprintf(stderr, format, arguments);
    fputs(terminal_is_raw() ? "\r\n" : "\n", stderr);
}

int complain(int code, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    say(format, arguments);
    va_end(arguments);
    open_line = NULL;               /* end it once only */
    return code;
}

void remark(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    say(format, arguments);
    va_end(arguments);
}
