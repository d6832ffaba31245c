; keep_none.asm - what a reset leaves of program and variables: nothing, where an image has no room for more
; Offers: KEEP BDRDY
; Uses:   run
; Room:   10 bytes

; KEEP - forgets the program and the variables
; In:  HL -> last byte of RAM   Out: VTOP   Clobbers all
KEEP:   SHLD    VTOP
        JMP     NEWPRG

; BDRDY - at the prompt: nothing; no sum of the variables is wanted
; Out: HL-> VSUM   Clobbers nothing else
BDRDY:  LXI     H,VSUM
        RET
