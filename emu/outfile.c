/* A file that a run writes. See outfile.h. */
#include "outfile.h"

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

#define lstat stat

/* (Windows removes no file that is open: one that another process has is not opened anew) */
static bool hold(FILE *file)
{
    (void)file;
    return true;
}

static bool settle(FILE *file)
{
    return !fflush(file) && !_commit(_fileno(file));
}

/* (Windows gives no other name to a file that is open) */
static bool take_place(outfile *f)
{
    if (!freopen("NUL", "wb", f->file)) {
        return false;
    }
    bool moved = MoveFileExA(f->part, f->name, MOVEFILE_REPLACE_EXISTING);
    bool opened = freopen(moved ? f->name : f->part, "ab", f->file);
    errno = moved ? errno : EACCES;
    return moved && opened;
}
#else
#include <sys/file.h>

/* A link is followed, one to nothing too: its own name is taken then. */
static char *followed(const char *name)
{
    char *found = realpath(name, NULL);
    return found ? found : strdup(name);
}

/* Keeps a file for this process alone; false: another one has it. (A file system without locks tells nothing.) */
static bool hold(FILE *file)
{
    return !flock(fileno(file), LOCK_EX | LOCK_NB) || errno != EWOULDBLOCK;
}

static bool settle(FILE *file)
{
    return !fflush(file) && !fsync(fileno(file));
}

static bool take_place(outfile *f)
{
    return !rename(f->part, f->name);
}
#endif

/* The end of a program that SAVE punches. */
enum { CTRL_Z = 0x1A };

/* Opens a part, which no other process writes. An older one goes by its name alone: it may be a link to something else. */
static FILE *begun(const char *part)
{
    struct stat old;
    FILE *file = !lstat(part, &old) && S_ISREG(old.st_mode) ? fopen(part, "rb") : NULL;
    bool is_held = file && !hold(file);
    if (file) {
        fclose(file);
    }
    if (is_held || (unlink(part) && errno != ENOENT)) {
        errno = is_held ? EBUSY : errno;
        return NULL;
    }
    file = fopen(part, "wb");
    if (file) {
        hold(file);
    }
    return file;
}

bool outfile_open(outfile *f, const char *name)
{
    struct stat file;
    bool is_there = !stat(name, &file);
    if (is_there && !S_ISREG(file.st_mode)) {
        return (f->file = fopen(name, "wb"));
    }
    /* (one that may not be written shall not be replaced) */
    if (is_there && access(name, W_OK)) {
        return false;
    }
    f->name = followed(name);
    f->part = f->name ? malloc(strlen(f->name) + sizeof OUTFILE_PART) : NULL;
    if (!f->part) {
        errno = ENOMEM;
        return false;
    }
    strcat(strcpy(f->part, f->name), OUTFILE_PART);
    f->file = begun(f->part);
    if (!f->file) {
        int why = errno;
        /* (it is not ours) */
        free(f->part);
        f->part = NULL;
        errno = why;
    }
    return f->file;
}

bool outfile_keep(outfile *f)
{
    if (!f->file || f->kept) {
        return true;
    }
    f->kept = !f->part || (settle(f->file) && take_place(f));
    return f->kept;
}

bool outfile_again(outfile *f)
{
    if (!f->part || !f->kept) {
        return true;
    }
    f->kept = false;
    fclose(f->file);
    return (f->file = begun(f->part));
}

bool outfile_punched(outfile *f, uint8_t byte)
{
    if (!f->part || byte == '\r' || !byte) {
        return true;
    }
    bool ended =
        !memcmp(f->end, "M30", TAPE_END) || !memcmp(f->end, "\nDD", TAPE_END) || !memcmp(f->end, "\0DD", TAPE_END);
    memmove(f->end, f->end + 1, TAPE_END - 1);
    f->end[TAPE_END - 1] = (char)byte;
    if (byte != '\n' && byte != CTRL_Z) {
        return true;
    }
    /* (line by line, so that a part is one of whole lines) */
    if (fflush(f->file)) {
        return false;
    }
    return (!ended && byte != CTRL_Z) || outfile_keep(f);
}

bool outfile_leave(outfile *f, const char **left)
{
    /* (a network's file system may say only now that its disk is full) */
    int fault = f->file && fclose(f->file) ? errno : 0;
    f->file = NULL;
    struct stat part;
    bool is_left = f->part && !f->kept && !stat(f->part, &part) && (part.st_size || unlink(f->part));
    *left = is_left ? f->part : NULL;
    errno = fault;
    return !fault;
}
