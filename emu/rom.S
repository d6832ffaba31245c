/* The ROM image that skg80 has built in, and its names: SKG80_ROM and SKG80_SYM are their files. */
        .section .rodata
        .global skg80_rom, skg80_sym
skg80_rom:
        .incbin SKG80_ROM
skg80_sym:
        .incbin SKG80_SYM
        .byte 0
        .section .note.GNU-stack, "", %progbits
