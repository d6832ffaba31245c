/* Machine code as a listing. See listing.h. */
#include "listing.h"

#include "disasm.h"

enum { RST_ERROR = 0xcf, RST_EXPECT = 0xe7, RST_CALC = 0xef };

/* Bytes behind a restart are its data. Gives the address behind. */
static uint16_t print_data(const calculator *k, const i8080 *c, uint8_t opcode, uint16_t address, FILE *out)
{
    if (k && (opcode == RST_ERROR || opcode == RST_EXPECT)) {
        fprintf(out, "%04X %-10s DB %02X\n", address, "", i8080_peek(c, address));
        return (uint16_t)(address + 1);
    }
    return k && opcode == RST_CALC ? calculator_print_code(k, c, address, LISTING_LONGEST, out) : address;
}

void listing_print(const symbols *s, const calculator *k, const i8080 *c, uint16_t address, unsigned count, FILE *out)
{
    while (count--) {
        const uint8_t code[] = { i8080_peek(c, address), i8080_peek(c, (uint16_t)(address + 1)),
                                 i8080_peek(c, (uint16_t)(address + 2)) };
        char text[DISASM_TEXT], place[SYMBOLS_PLACE];
        unsigned length = disasm(s, code, text);
        fprintf(out, "%04X %-10s %s\n", address, symbols_place(s, address, place), text);
        address = print_data(k, c, code[0], (uint16_t)(address + length), out);
    }
}
