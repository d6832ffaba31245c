/* The firmware's names. See symbols.h. */
#include "symbols.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { ROM_SIZE = 0x2000, NEAR = 0x400 };   /* NEAR: a label names no address farther behind it */

/* Labels of the DS lines in front of the restarts name gaps. */
static bool names_a_gap(const symbol *s)
{
    return !strncmp(s->name, "GAP", 3);
}

/* One line of the file, up to its LF; false when it is none. */
static bool read_line(const char *text, symbol *s)
{
    char line[96], more;
    unsigned value;
    snprintf(line, sizeof line, "%.*s", (int)strcspn(text, "\n"), text);
    int fields = sscanf(line, "%4x %15s %63s %c", &value, s->name, s->file, &more);
    if (fields < 2 || fields > 3 || strspn(line, "0123456789ABCDEF") != 4 || line[4] != ' ') {
        return false;
    }
    s->value = (uint16_t)value;
    s->label = fields == 3 && value < ROM_SIZE;
    return true;
}

static void place_labels(symbols *s)
{
    for (size_t i = 0; i < s->count; i++) {
        const symbol *one = &s->all[i];
        if (one->label && (!s->label_at[one->value] || names_a_gap(s->label_at[one->value]))) {
            s->label_at[one->value] = one;
        }
    }
    for (unsigned at = 1; at < ROM_SIZE; at++) {
        s->label_at[at] = s->label_at[at] ? s->label_at[at] : s->label_at[at - 1];
    }
}

symbols *symbols_new(const char *path, const char *text, char *error, size_t size)
{
    size_t lines = 0;
    for (const char *c = text; *c; c++) {
        lines += *c == '\n';
    }
    symbols *s = calloc(1, sizeof *s);
    if (!s || !(s->all = calloc(lines + 1, sizeof *s->all))) {
        snprintf(error, size, "%s: out of memory", path);
        free(s);
        return NULL;
    }
    for (const char *line = text; *line; line += strcspn(line, "\n"), line += *line == '\n') {
        if (!read_line(line, &s->all[s->count++])) {
            snprintf(error, size, "%s:%zu: not a line of a symbol file", path, s->count);
            symbols_free(s);
            return NULL;
        }
    }
    if (!s->count) {
        snprintf(error, size, "%s: no symbols", path);
        symbols_free(s);
        return NULL;
    }
    place_labels(s);
    return s;
}

void symbols_free(symbols *s)
{
    if (s) {
        free(s->all);
        free(s);
    }
}

static const symbol *find(const symbols *s, const char *name, size_t length)
{
    for (size_t i = 0; s && i < s->count; i++) {
        if (!strncasecmp(s->all[i].name, name, length) && !s->all[i].name[length]) {
            return &s->all[i];
        }
    }
    return NULL;
}

bool symbols_value(const symbols *s, const char *name, uint16_t *value)
{
    const symbol *found = strlen(name) <= SYMBOLS_NAME ? find(s, name, strlen(name)) : NULL;
    if (found) {
        *value = found->value;
    }
    return found;
}

const symbol *symbols_label(const symbols *s, uint16_t address)
{
    const symbol *label = s && address < ROM_SIZE ? s->label_at[address] : NULL;
    return label && address - label->value <= NEAR ? label : NULL;
}

const char *symbols_place(const symbols *s, uint16_t address, char text[SYMBOLS_PLACE])
{
    const symbol *label = symbols_label(s, address);
    if (!label) {
        snprintf(text, SYMBOLS_PLACE, "%04X", address);
    } else if (label->value == address) {
        snprintf(text, SYMBOLS_PLACE, "%s", label->name);
    } else {
        snprintf(text, SYMBOLS_PLACE, "%s+%d", label->name, address - label->value);
    }
    return text;
}

const char *symbols_exact(const symbols *s, uint16_t address, char text[SYMBOLS_NAMES])
{
    size_t length = 0;
    for (size_t i = 0; s && i < s->count; i++) {
        const symbol *one = &s->all[i];
        bool place = one->label || one->value >= ROM_SIZE;
        if (place && one->value == address && !names_a_gap(one) && length + strlen(one->name) + 2 <= SYMBOLS_NAMES) {
            length += (size_t)snprintf(text + length, SYMBOLS_NAMES - length, "%s%s", length ? "/" : "", one->name);
        }
    }
    return length ? text : NULL;
}

bool symbols_address(const symbols *s, const char *text, uint16_t *address)
{
    size_t length = strcspn(text, "+");
    const symbol *name = length && length <= SYMBOLS_NAME ? find(s, text, length) : NULL;
    char *end;
    if (name && (name->label || name->value >= ROM_SIZE)) {
        unsigned long distance = text[length] ? strtoul(text + length + 1, &end, 10) : 0;
        bool whole = !text[length] || (text[length + 1] >= '0' && text[length + 1] <= '9' && !*end);
        *address = (uint16_t)(name->value + distance);
        return whole && distance < 0x10000;
    }
    if (!*text || strlen(text) > 4 || strspn(text, "0123456789abcdefABCDEF") != strlen(text)) {
        return false;
    }
    *address = (uint16_t)strtoul(text, NULL, 16);
    return true;
}
