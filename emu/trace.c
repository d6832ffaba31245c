/* One line for each instruction. See trace.h. */
#include "trace.h"

#include "disasm.h"

bool trace_at_operation(const i8080 *c, const calculator *k)
{
    return k && c->pc == k->next;
}

void trace_operation(const i8080 *c, const calculator *k, FILE *out)
{
    char text[CALCULATOR_TEXT], place[SYMBOLS_PLACE];
    calculator_operation(k, c, c->bc, text);
    fprintf(out, "; %04X %-10s %-16s|", c->bc, symbols_place(k->names, c->bc, place), text);
    calculator_print_stack(k, c, out);
    fputc('\n', out);
}

void trace_instruction(const i8080 *c, const symbols *s, FILE *out)
{
    static const struct {
        uint8_t bit;
        char name;
    } flags[] = { { 0x80, 'S' }, { 0x40, 'Z' }, { 0x10, 'A' }, { 0x04, 'P' }, { 0x01, 'C' } };
    enum { FLAGS = sizeof flags / sizeof *flags };
    char text[DISASM_TEXT], place[SYMBOLS_PLACE], set[FLAGS + 1] = "";
    const uint8_t code[] = { i8080_peek(c, c->pc), i8080_peek(c, (uint16_t)(c->pc + 1)),
                             i8080_peek(c, (uint16_t)(c->pc + 2)) };
    disasm(s, code, text);
    for (unsigned i = 0; i < FLAGS; i++) {
        set[i] = c->f & flags[i].bit ? flags[i].name : '.';
    }
    fprintf(out, "%llu %04X %-10s %-14s A=%02X F=%s BC=%04X DE=%04X HL=%04X SP=%04X\n", (unsigned long long)c->cycles,
            c->pc, symbols_place(s, c->pc, place), text, c->a, set, c->bc, c->de, c->hl, c->sp);
}
