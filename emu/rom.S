/* The ROM image that skg80 has built in, and its names: SKG80_ROM and SKG80_SYM are their files. */
#if defined(__APPLE__)
#define NAME(name) _##name
        .section __TEXT,__const
#elif defined(_WIN32)
#define NAME(name) name
        .section .rdata,"dr"
#else
#define NAME(name) name
        .section .rodata
#endif
        .globl NAME(skg80_rom), NAME(skg80_sym)
NAME(skg80_rom):
        .incbin SKG80_ROM
NAME(skg80_sym):
        .incbin SKG80_SYM
        .byte 0
#if defined(__ELF__)
        .section .note.GNU-stack, "", %progbits
#endif
