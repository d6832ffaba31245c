/* Memory that survives power off. See store.h. */
#include "store.h"

#include <stddef.h>
#include <string.h>

enum { PLACES = 4, PLACE = 0x10000, FIRST = 0x100000, MAGIC = 0x50474b53 /* "SKGP" */, BLANK = 0xff };

_Static_assert(sizeof(store_copy) == FLASH_PAGE, "a copy's first page");
_Static_assert((STORE_PAGES + 1) * FLASH_PAGE <= PLACE, "a copy's place");

static uint32_t offset_of(unsigned shelf, uint32_t number)
{
    return FIRST + (shelf * PLACES + number % PLACES) * PLACE;
}

/* (four bits at a time: a table of 64 bytes) */
uint32_t store_sum(uint32_t sum, const void *bytes, uint32_t size)
{
    static const uint32_t of_4_bits[16] = { 0x00000000, 0x1db71064, 0x3b6e20c8, 0x26d930ac, 0x76dc4190, 0x6b6b51f4,
                                            0x4db26158, 0x5005713c, 0xedb88320, 0xf00f9344, 0xd6d6a3e8, 0xcb61b38c,
                                            0x9b64c2b0, 0x86d3d2d4, 0xa00ae278, 0xbdbdf21c };
    sum = ~sum;
    for (const uint8_t *b = bytes; size--; b++) {
        sum = of_4_bits[(sum ^ *b) & 15] ^ sum >> 4;
        sum = of_4_bits[(sum ^ *b >> 4) & 15] ^ sum >> 4;
    }
    return ~sum;
}

static bool is_sound(const store_copy *c)
{
    if (c->magic != MAGIC || c->pages > STORE_PAGES) {
        return false;
    }
    uint32_t sum = store_sum(0, c, offsetof(store_copy, sum));
    return store_sum(sum, c + 1, c->pages * FLASH_PAGE) == c->sum;
}

static bool is_blank(const uint8_t *bytes)
{
    for (uint32_t i = 0; i < PLACE; i++) {
        if (bytes[i] != BLANK) {
            return false;
        }
    }
    return true;
}

const store_copy *store_newest(unsigned shelf, bool *torn)
{
    const store_copy *newest = NULL;
    *torn = false;
    for (unsigned place = 0; place < PLACES; place++) {
        const store_copy *c = (const store_copy *)(const void *)flash_at(offset_of(shelf, place));
        if (is_sound(c)) {
            if (!newest || (int32_t)(c->number - newest->number) > 0) {
                newest = c;
            }
        } else if (!is_blank((const uint8_t *)c)) {
            *torn = true;
        }
    }
    return newest;
}

void store_keep(unsigned shelf, const uint8_t about[STORE_ABOUT], const uint8_t *const pages[], uint32_t count)
{
    bool torn;
    const store_copy *before = store_newest(shelf, &torn);
    store_copy c = { .magic = MAGIC, .number = before ? before->number + 1 : 0, .pages = count };
    memcpy(c.about, about, STORE_ABOUT);
    c.sum = store_sum(0, &c, offsetof(store_copy, sum));
    uint32_t offset = offset_of(shelf, c.number), size = (count + 1) * FLASH_PAGE;
    flash_erase(offset, (size + FLASH_SECTOR - 1) / FLASH_SECTOR * FLASH_SECTOR);
    for (uint32_t i = 0; i < count; i++) {
        c.sum = store_sum(c.sum, pages[i], FLASH_PAGE);
        flash_write(offset + (i + 1) * FLASH_PAGE, pages[i]);
    }
    flash_write(offset, (const uint8_t *)&c);
}
