/* The functions of a C library that emu/ calls; memory.c defines them. */
#ifndef PAGE_STDLIB_H
#define PAGE_STDLIB_H

#include <stddef.h>

void *malloc(size_t size);
void *calloc(size_t count, size_t size);
void *realloc(void *old, size_t size);
void free(void *bytes);

#endif
