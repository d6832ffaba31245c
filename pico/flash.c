/* Writing the flash. See flash.h. */
#include "flash.h"

enum { FUNCTIONS = 0x14, LOOK_UP = 0x18, BLOCK = 1 << 16, BLOCK_ERASE = 0xd8, XIP = 0x10000000 };

#define CODE(a, b) ((uint32_t)(a) | (uint32_t)(b) << 8)

typedef void plain(void);
typedef void erase(uint32_t offset, uint32_t size, uint32_t block, uint8_t command);
typedef void program(uint32_t offset, const uint8_t *data, uint32_t size);

/* A half-word at a place that the compiler must not know: it takes those near 0 for a mistake. */
static uintptr_t half_word(uintptr_t address)
{
    __asm__("" : "+r"(address));
    return *(const uint16_t *)address;
}

/* A routine of the boot ROM. */
static void *routine(uint32_t code)
{
    typedef void *look_up(uintptr_t table, uint32_t code);
    return ((look_up *)half_word(LOOK_UP))(half_word(FUNCTIONS), code);
}

static void leave_memory(void)
{
    ((plain *)routine(CODE('I', 'F')))(); /* connect_internal_flash */
    ((plain *)routine(CODE('E', 'X')))(); /* flash_exit_xip */
}

static void be_memory(void)
{
    ((plain *)routine(CODE('F', 'C')))(); /* flash_flush_cache */
    ((plain *)routine(CODE('C', 'X')))(); /* flash_enter_cmd_xip */
}

const uint8_t *flash_at(uint32_t offset)
{
    return (const uint8_t *)(uintptr_t)(XIP + offset);
}

void flash_erase(uint32_t offset, uint32_t size)
{
    erase *range_erase = (erase *)routine(CODE('R', 'E'));
    leave_memory();
    range_erase(offset, size, BLOCK, BLOCK_ERASE);
    be_memory();
}

void flash_write(uint32_t offset, const uint8_t page[FLASH_PAGE])
{
    program *range_program = (program *)routine(CODE('R', 'P'));
    leave_memory();
    range_program(offset, page, FLASH_PAGE);
    be_memory();
}
