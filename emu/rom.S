/* The ROM image that skg80 has built in: SKG80_ROM is its file. */
        .section .rodata
        .global skg80_rom
skg80_rom:
        .incbin SKG80_ROM
        .section .note.GNU-stack, "", %progbits
