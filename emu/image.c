/* Files of bytes and ROM images. See image.h. */
#include "image.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { HEX_DATA = 0, HEX_END = 1, HEX_SEGMENT = 2, HEX_START = 3, HEX_UPPER = 4, HEX_START32 = 5 };

uint8_t *image_read(const char *path, size_t limit, size_t *length, char *error, size_t size)
{
    FILE *file = fopen(path, "rb");
    if (!file) {
        snprintf(error, size, "%s: %s", path, strerror(errno));
        return NULL;
    }
    uint8_t *bytes = malloc(limit + 1);
    if (!bytes) {
        snprintf(error, size, "%s: out of memory", path);
        fclose(file);
        return NULL;
    }
    errno = 0;
    *length = fread(bytes, 1, limit + 1, file);
    if (ferror(file)) {
        snprintf(error, size, "%s: %s", path, strerror(errno));
    } else if (*length > limit) {
        snprintf(error, size, "%s: more than %zu bytes", path, limit);
    } else {
        fclose(file);
        bytes[*length] = '\0';
        return bytes;
    }
    fclose(file);
    free(bytes);
    return NULL;
}

static int hex_digit(char c)
{
    if (c >= '0' && c <= '9') {
        return c - '0';
    }
    c |= 0x20;
    return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

/* Reads one line's bytes (after the colon) into `record`; returns their number, or -1. */
static int hex_bytes(const char *line, uint8_t record[256 + 5])
{
    int count = 0;
    while (*line && *line != '\r' && *line != ' ') {
        int high = hex_digit(line[0]);
        int low = high < 0 ? -1 : hex_digit(line[1]);
        if (low < 0 || count == 256 + 5) {
            return -1;
        }
        record[count++] = (uint8_t)(high << 4 | low);
        line += 2;
    }
    return count;
}

/* Carries out one line of a .hex file; NULL, or its error. */
static const char *hex_line(const char *line, uint8_t *rom, bool *given, size_t rom_size, int *ended)
{
    uint8_t record[256 + 5];
    if (*line == '\0' || *line == '\r') {
        return NULL;
    }
    if (*ended) {
        return "more after the end record";
    }
    int count = *line == ':' ? hex_bytes(line + 1, record) : -1;
    if (count < 5) {
        return "not an Intel hex record";
    }
    unsigned length = record[0], address = record[1] << 8 | record[2], sum = 0;
    if (count != (int)length + 5) {
        return "the record's length is wrong";
    }
    for (int i = 0; i < count; i++) {
        sum += record[i];
    }
    if (sum & 0xff) {
        return "the checksum is wrong";
    }
    const uint8_t *data = record + 4;
    switch (record[3]) {
    case HEX_DATA:
        if (address + length > rom_size) {
            return "data past the end of the ROM";
        }
        memcpy(rom + address, data, length);
        memset(given + address, true, length);
        return NULL;
    case HEX_END:
        *ended = 1;
        return NULL;
    case HEX_SEGMENT:
    case HEX_UPPER:
        return length == 2 && !data[0] && !data[1] ? NULL : "an address past FFFF";
    case HEX_START:
    case HEX_START32:
        return NULL;
    default:
        return "unknown kind of record";
    }
}

int image_rom_of(const char *path, char *bytes, size_t length, uint8_t *rom, bool *given, size_t rom_size, char *error,
                 size_t size)
{
    const char *dot = strrchr(path, '.');
    int hex = dot && !strcasecmp(dot, ".hex");
    memset(rom, 0xff, rom_size);
    memset(given, !hex, rom_size);
    if (!hex) {
        bool whole = length == rom_size;
        if (whole) {
            memcpy(rom, bytes, length);
        } else {
            snprintf(error, size, "%s: %zu bytes, expected a ROM image of %zu", path, length, rom_size);
        }
        return whole ? 0 : -1;
    }
    int ended = 0, number = 0;
    const char *wrong = strlen(bytes) == length ? NULL : "not a text file";
    for (char *line = bytes, *next; !wrong && line; line = next) {
        next = strchr(line, '\n');
        if (next) {
            *next++ = '\0';
        }
        number++;
        wrong = hex_line(line, rom, given, rom_size, &ended);
    }
    if (wrong) {
        snprintf(error, size, "%s:%d: %s", path, number ? number : 1, wrong);
    } else if (!ended) {
        snprintf(error, size, "%s: no end record", path);
    } else {
        return 0;
    }
    return -1;
}

int image_rom(const char *path, uint8_t *rom, bool *given, size_t rom_size, char *error, size_t size)
{
    size_t length;
    uint8_t *bytes = image_read(path, IMAGE_FILE_LIMIT, &length, error, size);
    int failed = bytes ? image_rom_of(path, (char *)bytes, length, rom, given, rom_size, error, size) : -1;
    free(bytes);
    return failed;
}

uint32_t image_crc32(const uint8_t *bytes, size_t length)
{
    uint32_t crc = UINT32_MAX;
    for (size_t i = 0; i < length; i++) {
        crc ^= bytes[i];
        for (int bit = 0; bit < 8; bit++) {
            crc = crc >> 1 ^ (crc & 1 ? 0xedb88320 : 0);
        }
    }
    return ~crc;
}
