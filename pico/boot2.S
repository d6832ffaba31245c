@ The 256 bytes that the boot ROM loads and checks (uf2.py adds their sum). Its own routine lets the flash be read as
@ memory, slowly, by the command 03 that every flash has; then to the vectors, which stand behind.
        .syntax unified
        .cpu    cortex-m0plus
        .thumb
        .section .boot2, "ax"
        .global boot2
boot2:  movs    r0, #0x14       @ the boot ROM's table of functions, and its look-up
        ldrh    r0, [r0]
        ldr     r1, =0x5843     @ 'C','X': flash_enter_cmd_xip
        movs    r2, #0x18
        ldrh    r2, [r2]
        blx     r2
        blx     r0
        ldr     r0, =0x10000100
        ldr     r1, =0xe000ed08 @ VTOR
        str     r0, [r1]
        ldmia   r0, {r0, r1}
        msr     msp, r0
        bx      r1
        .ltorg
