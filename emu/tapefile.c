/* The file of a punched tape. See tapefile.h. */
#include "tapefile.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#ifdef _WIN32
#include <io.h>
#include <windows.h>

static char *followed(const char *name)
{
    return _fullpath(NULL, name, 0);
}

static bool settle(FILE *file)
{
    return !fflush(file) && !_commit(_fileno(file));
}

static bool take_place(const char *from, const char *to)
{
    if (MoveFileExA(from, to, MOVEFILE_REPLACE_EXISTING)) {
        return true;
    }
    errno = EACCES;
    return false;
}
#else
/* A link is followed, one to nothing too: its own name is taken then. */
static char *followed(const char *name)
{
    char *found = realpath(name, NULL);
    return found ? found : strdup(name);
}

static bool settle(FILE *file)
{
    return !fflush(file) && !fsync(fileno(file));
}

static bool take_place(const char *from, const char *to)
{
    return !rename(from, to);
}
#endif

/* The end of a program that SAVE punches. */
enum { CTRL_Z = 0x1A };

FILE *tapefile_open(tapefile *t, const char *name)
{
    struct stat file;
    bool is_there = !stat(name, &file);
    if (is_there && !S_ISREG(file.st_mode)) {
        return fopen(name, "wb");
    }
    /* (one that may not be written shall not be replaced) */
    if (is_there && access(name, W_OK)) {
        return NULL;
    }
    t->name = followed(name);
    t->part = t->name ? malloc(strlen(t->name) + sizeof ".part") : NULL;
    if (!t->part) {
        errno = ENOMEM;
        return NULL;
    }
    strcat(strcpy(t->part, t->name), ".part");
    return fopen(t->part, "wb");
}

FILE *tapefile_follow(tapefile *t, FILE *file, uint8_t byte)
{
    if (!t->part) {
        return file;
    }
    if (byte == '\r' || !byte) {
        return file;
    }
    bool ended =
        !memcmp(t->end, "M30", TAPE_END) || !memcmp(t->end, "\nDD", TAPE_END) || !memcmp(t->end, "\0DD", TAPE_END);
    memmove(t->end, t->end + 1, TAPE_END - 1);
    t->end[TAPE_END - 1] = (char)byte;
    if (byte != '\n' && byte != CTRL_Z) {
        return file;
    }
    ended |= byte == CTRL_Z;
    /* (line by line, so that a part is one of whole lines) */
    if (fflush(file)) {
        return NULL;
    }
    if (!ended || t->named) {
        return file;
    }
    /* (Windows gives no other name to a file that is open) */
    bool kept = settle(file);
    kept &= !fclose(file);
    if (!kept || !take_place(t->part, t->name)) {
        return NULL;
    }
    t->named = true;
    return fopen(t->name, "ab");
}

const char *tapefile_close(tapefile *t, FILE *file)
{
    struct stat left;
    if (!t->part || t->named) {
        return NULL;
    }
    if (file) {
        fclose(file);
    }
    bool is_left = !stat(t->part, &left);
    if (is_left && !left.st_size) {
        unlink(t->part);
        is_left = false;
    }
    return is_left ? t->part : NULL;
}
