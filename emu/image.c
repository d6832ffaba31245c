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

/* Carries out one line of a .hex file. */
static enum image_fault hex_line(const char *line, uint8_t *rom, bool *given, size_t rom_size, int *ended)
{
    uint8_t record[256 + 5];
    if (*line == '\0' || *line == '\r') {
        return IMAGE_GOOD;
    }
    if (*ended) {
        return IMAGE_AFTER_END;
    }
    int count = *line == ':' ? hex_bytes(line + 1, record) : -1;
    if (count < 5) {
        return IMAGE_NO_RECORD;
    }
    unsigned length = record[0], address = record[1] << 8 | record[2], sum = 0;
    if (count != (int)length + 5) {
        return IMAGE_RECORD_LENGTH;
    }
    for (int i = 0; i < count; i++) {
        sum += record[i];
    }
    if (sum & 0xff) {
        return IMAGE_CHECKSUM;
    }
    const uint8_t *data = record + 4;
    switch (record[3]) {
    case HEX_DATA:
        if (address + length > rom_size) {
            return IMAGE_PAST_ROM;
        }
        memcpy(rom + address, data, length);
        memset(given + address, true, length);
        return IMAGE_GOOD;
    case HEX_END:
        *ended = 1;
        return IMAGE_GOOD;
    case HEX_SEGMENT:
    case HEX_UPPER:
        return length == 2 && !data[0] && !data[1] ? IMAGE_GOOD : IMAGE_PAST_FFFF;
    case HEX_START:
    case HEX_START32:
        return IMAGE_GOOD;
    default:
        return IMAGE_KIND;
    }
}

enum image_fault image_rom_of(const char *path, char *bytes, size_t length, uint8_t *rom, bool *given, size_t rom_size,
                              int *line)
{
    const char *dot = strrchr(path, '.');
    int hex = dot && !strcasecmp(dot, ".hex");
    memset(rom, 0xff, rom_size);
    memset(given, !hex, rom_size);
    *line = 0;
    if (!hex) {
        if (length != rom_size) {
            return IMAGE_LENGTH;
        }
        memcpy(rom, bytes, length);
        return IMAGE_GOOD;
    }
    if (strlen(bytes) != length) {
        *line = 1;
        return IMAGE_NO_TEXT;
    }
    int ended = 0;
    for (char *text = bytes, *next; text; text = next) {
        next = strchr(text, '\n');
        if (next) {
            *next++ = '\0';
        }
        ++*line;
        enum image_fault fault = hex_line(text, rom, given, rom_size, &ended);
        if (fault) {
            return fault;
        }
    }
    *line = 0;
    return ended ? IMAGE_GOOD : IMAGE_NO_END;
}

static const char *const SAID[] = {
    [IMAGE_NO_TEXT] = "not a text file",
    [IMAGE_NO_RECORD] = "not an Intel hex record",
    [IMAGE_RECORD_LENGTH] = "the record's length is wrong",
    [IMAGE_CHECKSUM] = "the checksum is wrong",
    [IMAGE_PAST_ROM] = "data past the end of the ROM",
    [IMAGE_PAST_FFFF] = "an address past FFFF",
    [IMAGE_KIND] = "unknown kind of record",
    [IMAGE_AFTER_END] = "more after the end record",
    [IMAGE_NO_END] = "no end record",
};

int image_rom(const char *path, uint8_t *rom, bool *given, size_t rom_size, char *error, size_t size)
{
    size_t length;
    int line;
    uint8_t *bytes = image_read(path, IMAGE_FILE_LIMIT, &length, error, size);
    if (!bytes) {
        return -1;
    }
    enum image_fault fault = image_rom_of(path, (char *)bytes, length, rom, given, rom_size, &line);
    free(bytes);
    if (fault == IMAGE_LENGTH) {
        snprintf(error, size, "%s: %zu bytes, expected a ROM image of %zu", path, length, rom_size);
    } else if (line) {
        snprintf(error, size, "%s:%d: %s", path, line, SAID[fault]);
    } else if (fault) {
        snprintf(error, size, "%s: %s", path, SAID[fault]);
    }
    return fault ? -1 : 0;
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
