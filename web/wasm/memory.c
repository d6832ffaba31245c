/* Memory and strings for a module without a C library.
 *
 * The heap: pieces in a row behind the data, each with its size in front. A freed piece goes onto a list, and the next
 * request that fits it gets it whole; pieces are never joined again. That is enough for a board or two and queues that
 * seldom grow.
 *
 * NOT IMPLEMENTED: alignment above 16; more threads than one.
 */
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { PAGE = 65536, ALIGN = 16 };

typedef struct piece {
    size_t size;
    struct piece *next;     /* on the list of free ones */
    char padding[ALIGN - sizeof(size_t) - sizeof(struct piece *)];
} piece;

_Static_assert(sizeof(piece) == ALIGN, "what malloc gives is aligned");

extern unsigned char __heap_base;   /* the linker's */

static piece *unused;
static uintptr_t heap_end;

void *malloc(size_t size)
{
    size = (size + ALIGN - 1) & ~(size_t)(ALIGN - 1);
    for (piece **at = &unused; *at; at = &(*at)->next) {
        piece *found = *at;
        if (found->size >= size) {
            *at = found->next;
            return found + 1;
        }
    }
    if (!heap_end) {
        heap_end = ((uintptr_t)&__heap_base + ALIGN - 1) & ~(uintptr_t)(ALIGN - 1);
    }
    uintptr_t wanted = heap_end + sizeof(piece) + size;
    uintptr_t there = (uintptr_t)__builtin_wasm_memory_size(0) * PAGE;
    if (wanted > there && __builtin_wasm_memory_grow(0, (wanted - there + PAGE - 1) / PAGE) == SIZE_MAX) {
        return NULL;
    }
    piece *made = (piece *)heap_end;
    made->size = size;
    heap_end = wanted;
    return made + 1;
}

void free(void *bytes)
{
    if (bytes) {
        piece *freed = (piece *)bytes - 1;
        freed->next = unused;
        unused = freed;
    }
}

void *calloc(size_t count, size_t size)
{
    void *made = malloc(count * size);
    if (made) {
        memset(made, 0, count * size);
    }
    return made;
}

void *realloc(void *old, size_t size)
{
    if (old && ((piece *)old - 1)->size >= size) {
        return old;
    }
    void *made = malloc(size);
    if (made && old) {
        memcpy(made, old, ((piece *)old - 1)->size);
        free(old);
    }
    return made;
}

/* (-fno-builtin: else the compiler turns each loop into a call of the function itself) */

void *memset(void *to, int value, size_t length)
{
    unsigned char *at = to;
    while (length--) {
        *at++ = (unsigned char)value;
    }
    return to;
}

void *memcpy(void *restrict to, const void *restrict from, size_t length)
{
    return memmove(to, from, length);
}

void *memmove(void *to, const void *from, size_t length)
{
    unsigned char *at = to;
    const unsigned char *source = from;
    if (at <= source) {
        while (length--) {
            *at++ = *source++;
        }
    } else {
        while (length--) {
            at[length] = source[length];
        }
    }
    return to;
}

int memcmp(const void *a, const void *b, size_t length)
{
    const unsigned char *p = a, *q = b;
    for (; length; length--, p++, q++) {
        if (*p != *q) {
            return *p - *q;
        }
    }
    return 0;
}

int strcmp(const char *a, const char *b)
{
    for (; *a && *a == *b; a++, b++) {
    }
    return (unsigned char)*a - (unsigned char)*b;
}
