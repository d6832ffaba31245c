; keep_none.asm - what a reset leaves of program and variables: nothing, where an image has no room for more
; Offers: KEEP
; Uses:   run
; Room:   6 bytes

; KEEP - forgets the program and the variables
; In:  HL -> last byte of RAM   Out: VTOP   Clobbers all
KEEP:   SHLD    VTOP
        JMP     NEWPRG
