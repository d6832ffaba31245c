/* The firmware's byte-code and floats as readable text. See calculator.h. */
#include "calculator.h"

#include <math.h>
#include <string.h>
#include <strings.h>

enum {
    // clang-format off
    OPERATIONS = 0x40, LOADS = 0x40, STORES = 0x80, CONSTANTS = 0xc0,  /* where each kind of code begins */
    // clang-format on
    FLOAT = 5,                      /* bytes */
    DEPTH = 12,                     /* floats on the stack */
    EXCESS = 128
};

static void add_name(calculator *k, unsigned code, const char *name)
{
    char *text = k->code[code];
    size_t length = strlen(text);
    if (length + strlen(name) + 2 < CALCULATOR_TEXT / 2) {
        snprintf(text + length, CALCULATOR_TEXT - length, "%s%s", length ? "/" : "", name);
    }
}

/* The register that a name loads, if another name stores it; else CALCULATOR_REGISTERS. */
static unsigned register_of(const symbols *names, const symbol *s)
{
    char other[SYMBOLS_NAME + 1];
    uint16_t code;
    snprintf(other, sizeof other, "S%s", s->name + 1);
    bool load = !s->label && s->name[0] == 'L' && s->value >= LOADS && s->value < STORES;
    bool pair = load && symbols_value(names, other, &code) && code == s->value + STORES - LOADS;
    return pair ? s->value - LOADS : CALCULATOR_REGISTERS;
}

const char *calculator_init(calculator *k, const symbols *names)
{
    uint16_t end, leave;
    const struct {
        const char *name;
        uint16_t *value;
    } wanted[] = {
        // clang-format off
        { "CALC1", &k->next }, { "FSTK", &k->stack }, { "FSP", &k->stack_pointer }, { "MREG", &k->registers },
        { "CONTAB", &k->constants }, { "QEND", &end }, { "QRET", &leave },
        // clang-format on
    };
    memset(k, 0, sizeof *k);
    for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++) {
        if (!symbols_value(names, wanted[i].name, wanted[i].value)) {
            return wanted[i].name;
        }
    }
    k->names = names;
    k->end = (uint8_t)end;
    k->leave = (uint8_t)leave;
    for (size_t i = 0; i < names->count; i++) {
        const symbol *s = &names->all[i];
        unsigned number = register_of(names, s);
        if (number < CALCULATOR_REGISTERS) {
            add_name(k, LOADS + number, s->name);
            char store[SYMBOLS_NAME + 1];
            snprintf(store, sizeof store, "S%s", s->name + 1);
            add_name(k, STORES + number, store);
        } else if (!s->label && s->name[0] == 'Q'
                   && (s->value < OPERATIONS || (s->value >= CONSTANTS && s->value < 256))) {
            add_name(k, s->value, s->name);
            k->distance[s->value] |= s->value < OPERATIONS && s->name[1] == 'J';
        }
    }
    for (unsigned code = k->leave + 1u; code < CALCULATOR_CODES; code++) {
        const char *name = k->code[code - k->leave];
        if (*name && !k->distance[code - k->leave]) {
            snprintf(k->code[code], CALCULATOR_TEXT, "%.*s+QRET", CALCULATOR_TEXT / 2, name);
        }
    }
    return NULL;
}

double calculator_float(const uint8_t bytes[5])
{
    uint32_t mantissa = (bytes[1] | 0x80u) << 24 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 8 | bytes[4];
    double value = ldexp(mantissa, bytes[0] - EXCESS - 32);
    return bytes[0] == 0 ? 0 : bytes[1] & 0x80 ? -value : value;
}

static double float_at(const i8080 *c, unsigned address)
{
    uint8_t bytes[FLOAT];
    for (unsigned i = 0; i < FLOAT; i++) {
        bytes[i] = i8080_peek(c, (uint16_t)(address + i));
    }
    return calculator_float(bytes);
}

/* The target of the jump at an address: its distance counts from its second byte on. */
static uint16_t jump_target(const i8080 *c, uint16_t address)
{
    return (uint16_t)(address + 1 + (int8_t)i8080_peek(c, (uint16_t)(address + 1)));
}

unsigned calculator_operation(const calculator *k, const i8080 *c, uint16_t address, char text[CALCULATOR_TEXT])
{
    uint8_t code = i8080_peek(c, address);
    const char *name = k->code[code];
    char number[8], place[SYMBOLS_PLACE];
    snprintf(number, sizeof number, "?%02X", code);
    name = *name ? name : number;
    if (k->distance[code]) {
        snprintf(text, CALCULATOR_TEXT, "%s %s", name, symbols_place(k->names, jump_target(c, address), place));
        return 2;
    }
    if (code >= CONSTANTS && code < k->leave) {
        snprintf(text, CALCULATOR_TEXT, "%s (%.9g)", name, float_at(c, k->constants + FLOAT * (code - CONSTANTS)));
    } else if (code >= LOADS && code < STORES) {
        snprintf(text, CALCULATOR_TEXT, "%s (%.9g)", name, float_at(c, k->registers + FLOAT * (code - LOADS)));
    } else {
        snprintf(text, CALCULATOR_TEXT, "%s", name);
    }
    return 1;
}

void calculator_print_stack(const calculator *k, const i8080 *c, FILE *out)
{
    unsigned top = i8080_peek(c, k->stack_pointer) | i8080_peek(c, (uint16_t)(k->stack_pointer + 1)) << 8;
    unsigned depth = (uint8_t)(top + FLOAT - k->stack) / FLOAT;
    if (depth > DEPTH) {
        fprintf(out, " (FSP is %04X)", top);
        return;
    }
    for (unsigned i = 0; i < depth; i++) {
        fprintf(out, " %.9g", float_at(c, k->stack + FLOAT * i));
    }
}

/* Is that one of the names, A/B/C? Each begins with a letter that may be left out. */
static bool is_named(const char *names, const char *name)
{
    size_t length = strlen(name);
    while (*names) {
        size_t one = strcspn(names, "/");
        if ((one == length && !strncasecmp(names, name, one))
            || (one == length + 1 && !strncasecmp(names + 1, name, length))) {
            return true;
        }
        names += one + (names[one] == '/');
    }
    return false;
}

static void print_register(const calculator *k, const i8080 *c, unsigned number, FILE *out)
{
    char names[CALCULATOR_TEXT] = "";
    for (const char *from = k->code[LOADS + number]; *from; from += strcspn(from, "/"), from += *from == '/') {
        size_t length = strlen(names);
        snprintf(names + length, sizeof names - length, "%s%.*s", length ? "/" : "", (int)strcspn(from, "/") - 1,
                 from + 1);
    }
    fprintf(out, "M%-2u %-12s %.9g\n", number, names, float_at(c, k->registers + FLOAT * number));
}

bool calculator_print_registers(const calculator *k, const i8080 *c, const char *name, FILE *out)
{
    bool found = false;
    for (unsigned number = 0; number < CALCULATOR_REGISTERS; number++) {
        const char *load = k->code[LOADS + number], *store = k->code[STORES + number];
        char plain[8];
        snprintf(plain, sizeof plain, "M%u", number);
        if (name ? is_named(load, name) || is_named(store, name) || !strcasecmp(plain, name)
                 : *load && float_at(c, k->registers + FLOAT * number) != 0) {
            print_register(k, c, number, out);
            found = true;
        }
    }
    return found || !name;
}

uint16_t calculator_print_code(const calculator *k, const i8080 *c, uint16_t address, unsigned count, FILE *out)
{
    bool target[0x100] = { false }; /* of a jump, by the low byte of its address: jumps are short */
    for (bool ends = false; !ends && count; count--) {
        char text[CALCULATOR_TEXT], place[SYMBOLS_PLACE];
        uint8_t code = i8080_peek(c, address);
        if (k->distance[code]) {
            target[jump_target(c, address) & 0xff] = true;
        }
        unsigned length = calculator_operation(k, c, address, text);
        fprintf(out, "%04X %-10s %s\n", address, symbols_place(k->names, address, place), text);
        target[address & 0xff] = false;
        address = (uint16_t)(address + length);
        ends = code == k->end || (code >= k->leave && !target[address & 0xff]);
    }
    return address;
}
