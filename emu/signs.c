/* Signs that are not ASCII. See signs.h. */
#include "signs.h"

#include <stdio.h>
#include <string.h>

enum { WIDE_FIRST = 0xff01, WIDE_LAST = 0xff5e }; /* the full-width forms of ! to ~ */

typedef struct {
    char sign;
    const char *others;
} row;

/* (blanks by their numbers: they cannot be told apart in a source) */
static const row SIGNS[] = {
    { ' ', "\u00a0\u2000\u2001\u2002\u2003\u2004\u2005\u2006\u2007\u2008\u2009\u200a\u202f\u205f\u3000" },
    { '-', "\u2010\u2011\u2012\u2013\u2014\u2015\u2212" },
    { '*', "\u00d7\u2217" },
    { '/', "\u00f7\u2044\u2215" },
    { ':', "\u2236" },
    { '.', "\u3002" },
    { '"', "\u201c\u201d\u201e\u201f\u2033" },
    { '\'', "\u2018\u2019\u201a\u201b\u2032" },
};

/* Bytes of the character that a lead byte begins; 0: it begins none. */
static size_t length_of(uint8_t lead)
{
    return lead < 0x80 ? 1 : lead < 0xc2 ? 0 : lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : lead < 0xf5 ? 4 : 0;
}

/* May this byte be the next of a character? (The second one rules out longer forms than needed, and surrogates.) */
static bool fits(const uint8_t *bytes, size_t at)
{
    uint8_t byte = bytes[at];
    if (at == 1) {
        switch (bytes[0]) {
        case 0xe0:
            return byte >= 0xa0 && byte <= 0xbf;
        case 0xed:
            return byte >= 0x80 && byte <= 0x9f;
        case 0xf0:
            return byte >= 0x90 && byte <= 0xbf;
        case 0xf4:
            return byte >= 0x80 && byte <= 0x8f;
        }
    }
    return byte >= 0x80 && byte <= 0xbf;
}

/* The number of a whole character. */
static uint32_t number_of(const uint8_t *bytes, size_t used)
{
    static const uint8_t lead[] = { 0, 0x7f, 0x1f, 0x0f, 0x07 };
    uint32_t number = bytes[0] & lead[used];
    for (size_t i = 1; i < used; i++) {
        number = number << 6 | (bytes[i] & 0x3f);
    }
    return number;
}

int signs_read(const uint8_t *bytes, size_t length, size_t *used)
{
    size_t whole = length_of(bytes[0]);
    *used = 1;
    if (whole <= 1) {
        return whole ? bytes[0] : SIGNS_STRANGE;
    }
    for (size_t at = 1; at < whole; at++) {
        if (at == length) {
            return SIGNS_MORE;
        }
        if (!fits(bytes, at)) {
            return SIGNS_STRANGE;
        }
    }
    *used = whole;
    uint32_t number = number_of(bytes, whole);
    if (number >= WIDE_FIRST && number <= WIDE_LAST) {
        return (int)(number - WIDE_FIRST) + '!';
    }
    char character[5] = "";
    memcpy(character, bytes, whole);
    for (size_t i = 0; i < sizeof SIGNS / sizeof *SIGNS; i++) {
        if (strstr(SIGNS[i].others, character)) {
            return SIGNS[i].sign;
        }
    }
    return SIGNS_STRANGE;
}

/* Is this character seen, where it stands? (Not controls, marks that turn the writing's direction, or unknown ones.) */
static bool is_seen(uint32_t number)
{
    static const uint32_t seen[][2] = {
        { 0xa1, 0xac },     { 0xae, 0x2ff },    { 0x370, 0x482 },   { 0x48a, 0x52f },   { 0x1e00, 0x1fff },
        { 0x2010, 0x2027 }, { 0x2030, 0x205e }, { 0x2070, 0x20bf }, { 0x2100, 0x2bff }, { 0x3001, 0x3029 },
        { 0x3041, 0x3096 }, { 0x30a1, 0x30ff }, { 0x3400, 0x9fff }, { 0xac00, 0xd7a3 }, { 0xffe0, 0xffe6 },
    };
    for (size_t i = 0; i < sizeof seen / sizeof *seen; i++) {
        if (number >= seen[i][0] && number <= seen[i][1]) {
            return true;
        }
    }
    return false;
}

void signs_show(const uint8_t *bytes, size_t used, char shown[SIGNS_SHOWN])
{
    uint32_t number = number_of(bytes, used);
    if (used == 1) {
        snprintf(shown, SIGNS_SHOWN, "byte %02XH", bytes[0]);
    } else if (is_seen(number)) {
        snprintf(shown, SIGNS_SHOWN, "'%.*s'", (int)used, (const char *)bytes);
    } else {
        snprintf(shown, SIGNS_SHOWN, "U+%04X", (unsigned)number);
    }
}

bool signs_have_parity(const uint8_t *bytes, size_t length)
{
    enum { DELETED = 0xff };
    size_t even = 0, odd = 0, high = 0;
    for (size_t i = 0; i < length; i++) {
        if (bytes[i] && bytes[i] != DELETED) {
            unsigned bits = bytes[i];
            bits ^= bits >> 4;
            bits ^= bits >> 2;
            bits ^= bits >> 1;
            odd += bits & 1;
            even += ~bits & 1;
            high += bytes[i] >> 7;
        }
    }
    return high && (!even || !odd || high == even + odd);
}
