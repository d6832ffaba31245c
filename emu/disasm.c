/* 8080 machine code as mnemonics. See disasm.h.
 *
 * An opcode is three octal digits: a kind, and two fields that name registers, pairs, conditions or operations.
 */
#include "disasm.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static const char *const REGISTER[] = { "B", "C", "D", "E", "H", "L", "M", "A" };
static const char *const PAIR[] = { "B", "D", "H", "SP" };
static const char *const CONDITION[] = { "NZ", "Z", "NC", "C", "PO", "PE", "P", "M" };
static const char *const ARITHMETIC[] = { "ADD", "ADC", "SUB", "SBB", "ANA", "XRA", "ORA", "CMP" };
static const char *const IMMEDIATE[] = { "ADI", "ACI", "SUI", "SBI", "ANI", "XRI", "ORI", "CPI" };
static const char *const ROTATE[] = { "RLC", "RRC", "RAL", "RAR", "DAA", "CMA", "STC", "CMC" };

/* A format's operand: none, a byte, or a word behind the opcode. */
enum { NONE = 1, BYTE = 2, WORD = 3 };

enum { OPCODE_HLT = 0x76, OPCODE_RST = 0xc7 };

enum { NAME = 16 };

/* Writes a mnemonic with its registers, and returns the instruction's length. */
__attribute__((format(printf, 3, 4))) static unsigned put(char text[NAME], unsigned length, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, NAME, format, arguments);
    va_end(arguments);
    return length;
}

/* Opcodes 00 to 3F; y and z are the second and third octal digit. */
static unsigned low_quarter(unsigned y, unsigned z, char text[NAME])
{
    static const char *const memory[] = { "STAX B", "LDAX B", "STAX D", "LDAX D", "SHLD", "LHLD", "STA", "LDA" };
    const char *pair = PAIR[y >> 1];
    switch (z) {
    case 0:
        return put(text, NONE, "NOP");
    case 1:
        return put(text, y & 1 ? NONE : WORD, "%s %s", y & 1 ? "DAD" : "LXI", pair);
    case 2:
        return put(text, y < 4 ? NONE : WORD, "%s", memory[y]);
    case 3:
        return put(text, NONE, "%s %s", y & 1 ? "DCX" : "INX", pair);
    case 6:
        return put(text, BYTE, "MVI %s", REGISTER[y]);
    case 7:
        return put(text, NONE, "%s", ROTATE[y]);
    default:
        return put(text, NONE, "%s %s", z == 4 ? "INR" : "DCR", REGISTER[y]);
    }
}

/* Opcodes C0 to FF. */
static unsigned high_quarter(unsigned y, unsigned z, char text[NAME])
{
    static const struct {
        const char *name;
        uint8_t operand;
    // clang-format off
    } jumps[] = { { "JMP", WORD }, { "JMP", WORD }, { "OUT", BYTE }, { "IN", BYTE },
                  { "XTHL", NONE }, { "XCHG", NONE }, { "DI", NONE }, { "EI", NONE } },
      odd[] = { { "RET", NONE }, { "RET", NONE }, { "PCHL", NONE }, { "SPHL", NONE } };
    // clang-format on
    const char *pair = y >> 1 == 3 ? "PSW" : PAIR[y >> 1];
    switch (z) {
    case 0:
        return put(text, NONE, "R%s", CONDITION[y]);
    case 1:
        if (y & 1) {
            return put(text, odd[y >> 1].operand, "%s", odd[y >> 1].name);
        }
        return put(text, NONE, "POP %s", pair);
    case 2:
        return put(text, WORD, "J%s", CONDITION[y]);
    case 3:
        return put(text, jumps[y].operand, "%s", jumps[y].name);
    case 4:
        return put(text, WORD, "C%s", CONDITION[y]);
    case 5:
        if (y & 1) {
            return put(text, WORD, "CALL");
        }
        return put(text, NONE, "PUSH %s", pair);
    case 6:
        return put(text, BYTE, "%s", IMMEDIATE[y]);
    default:
        return put(text, NONE, "RST %u", y);
    }
}

unsigned disasm(const symbols *s, const uint8_t code[3], char text[DISASM_TEXT])
{
    unsigned y = code[0] >> 3 & 7, z = code[0] & 7, length = NONE;
    uint16_t word = (uint16_t)(code[1] | code[2] << 8);
    char name[NAME];
    switch (code[0] >> 6) {
    case 0:
        length = low_quarter(y, z, name);
        break;
    case 1:
        if (code[0] == OPCODE_HLT) {
            put(name, NONE, "HLT");
        } else {
            put(name, NONE, "MOV %s,%s", REGISTER[y], REGISTER[z]);
        }
        break;
    case 2:
        put(name, NONE, "%s %s", ARITHMETIC[y], REGISTER[z]);
        break;
    default:
        length = high_quarter(y, z, name);
    }
    char names[SYMBOLS_NAMES];
    const char *comma = strchr(name, ' ') ? "," : " ";
    const char *place = length == WORD ? symbols_exact(s, word, names) : NULL;
    const char *restart = (code[0] & OPCODE_RST) == OPCODE_RST ? symbols_exact(s, code[0] & 0x38, names) : NULL;
    if (restart) {
        snprintf(text, DISASM_TEXT, "%s %s", name, restart);
    } else if (length == NONE) {
        snprintf(text, DISASM_TEXT, "%s", name);
    } else if (length == BYTE) {
        snprintf(text, DISASM_TEXT, "%s%s%02X", name, comma, code[1]);
    } else if (place) {
        snprintf(text, DISASM_TEXT, "%s%s%s", name, comma, place);
    } else {
        snprintf(text, DISASM_TEXT, "%s%s%04X", name, comma, word);
    }
    return length;
}
