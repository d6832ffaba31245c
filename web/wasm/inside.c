/* The machine's inside for the page: the functions of inside.wasm that firmware.ts calls
 *
 * What `skg80 --debug` prints of the firmware, by its own code: names, listings, the calculator's values. A copy of the
 * board's memory is looked at. What a function takes stands in the buffer; a text that it gives is there until the next
 * call.
 */
#include "../../emu/listing.h"

#include <stdlib.h>

#define EXPORT(name) __attribute__((export_name(#name)))

enum { NONE = -1 };             /* no such name, no such address */

static symbols *names;
static calculator its_calculator;
static i8080 memory;            /* (a processor that never runs) */
static char *buffer;

/* A text that is being written. */
static struct {
    char *bytes;
    size_t length;
    FILE *file;
} text;

static FILE *write_text(void)
{
    free(text.bytes);
    text.bytes = NULL;
    text.file = open_memstream(&text.bytes, &text.length);
    if (!text.file) {
        __builtin_trap();       /* no memory: the page says that the debugger does not come */
    }
    return text.file;
}

static const char *written(void)
{
    fclose(text.file);
    return text.bytes;
}

/* The buffer, of so many bytes. */
EXPORT(inside_buffer) char *inside_buffer(uint32_t length)
{
    free(buffer);
    return buffer = malloc(length);
}

/* Reads the .sym file in the buffer. The reason where it is none, or a name that is missing; empty: done. */
EXPORT(inside_names) const char *inside_names(void)
{
    static char error[64];
    names = symbols_new("skg.sym", buffer, error, sizeof error);
    i8080_init(&memory, NULL, NULL, NULL);
    const char *missing = names ? calculator_init(&its_calculator, names) : error;
    return missing ? missing : "";
}

/* Takes the buffer for the board's memory. */
EXPORT(inside_memory) void inside_memory(void)
{
    for (unsigned i = 0; i < I8080_SPACE; i++) {
        i8080_poke(&memory, (uint16_t)i, (uint8_t)buffer[i]);
    }
}

/* The value of the name in the buffer. */
EXPORT(inside_value) int32_t inside_value(void)
{
    uint16_t value;
    return symbols_value(names, buffer, &value) ? value : NONE;
}

/* The address that a user wrote into the buffer. */
EXPORT(inside_address) int32_t inside_address(void)
{
    uint16_t address;
    return symbols_address(names, buffer, &address) ? address : NONE;
}

EXPORT(inside_place) const char *inside_place(uint32_t address)
{
    static char place[SYMBOLS_PLACE];
    return symbols_place(names, (uint16_t)address, place);
}

/* The source file of what stands at an address; empty where nothing has a name. */
EXPORT(inside_file) const char *inside_file(uint32_t address)
{
    const symbol *label = symbols_label(names, (uint16_t)address);
    return label ? label->file : "";
}

EXPORT(inside_listing) const char *inside_listing(uint32_t address, uint32_t count)
{
    listing_print(names, &its_calculator, &memory, (uint16_t)address, count, write_text());
    return written();
}

EXPORT(inside_code) const char *inside_code(uint32_t address, uint32_t count)
{
    calculator_print_code(&its_calculator, &memory, (uint16_t)address, count, write_text());
    return written();
}

EXPORT(inside_floats) const char *inside_floats(void)
{
    calculator_print_stack(&its_calculator, &memory, write_text());
    return written();
}

EXPORT(inside_registers) const char *inside_registers(void)
{
    calculator_print_registers(&its_calculator, &memory, NULL, write_text());
    return written();
}
