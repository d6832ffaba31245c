; keep.asm - what a reset leaves of program and variables: all that is sound
; Offers: KEEP BDRDY
; Uses:   io program run start
; Room:   83 bytes

; KEEP - keeps the lines of the program up to the first one that has changed, and the variables when none has
; In:  HL -> last byte of RAM   Out: VTOP   Clobbers all
KEEP:   XCHG
        LHLD    VTOP
        CALL    CPHD
        XCHG
        SHLD    VTOP
        CNZ     NEWPRG          ; VTOP is the signature: not the RAM that it was
        LXI     H,PROG
KEEP1:  SHLD    PEND            ; sound so far
        MOV     A,M
        ORA     A
        JZ      KEEP2
        CALL    SUMREC
        ORA     A
        JZ      KEEP1
        LHLD    PEND
        MVI     M,0             ; from here on it is lost
        CALL    PUTSI
        DB      CCR,CLF,"DAMAGE",0C4H ; DAMAGED
KEEP2:  CALL    BDRDY
        CNZ     CLEAR
        JMP     FRESH           ; (once more does no harm)

; BDRDY - at the prompt: check sum of the variables, to VSUM
; Out: Z when it is the same as last time, HL-> VSUM   Clobbers A, B, C
BDRDY:  LHLD    VBOT
        XRA     A
        SUB     L
        MOV     B,A             ; to the end of the page
BDRD1:  CALL    SUMON           ; then whole pages: B = 0
        MOV     C,A
        LDA     VTOP+1
        INR     A
        CMP     H
        MOV     A,C
        JNZ     BDRD1
        LXI     H,VSUM
        CMP     M
        MOV     M,A
        RET
