; io.asm - the teletype: what is printed, the keyboard
; Offers: TYPECH PAPON BREAK BROKEN ERTAPE CRLF PUTSI PUTS PUT2D PUT1D
; Uses:   [ports] start
; Room:   71 bytes
;
; OUTSEL says where characters go: 0 nowhere, 1 paper and punch, else paper.
; KEYB holds the last key typed ahead, 0 when there is none.  ctrl-C stays in it
; until BREAK looks at it, ctrl-S holds all output until the next key.

;! COLS == OUTSEL+1 and LASTC == COLS+1 -- TYPECH walks back from LASTC

; TYPECH - the work of RST 2
; In:  A = character; PSW, HL and BC on the stack   Clobbers nothing
TYPECH: MOV     B,A
        LXI     H,LASTC
        MOV     M,A
        DCX     H
        INR     M               ; COLS
        JNZ     PUTC3
        DCR     M               ; (255 and more are all the same)
PUTC3:  DCX     H
        MOV     C,M             ; OUTSEL
        CALL    PAPER
        POP     B
        POP     H
        POP     PSW
        RET

; PAPON - paper on, no punch
; Clobbers A, HL
PAPON:  MVI     A,2
        STA     OUTSEL
; (fall into BREAK)

; BREAK - has the operator broken in?
; Out: A = KEYB, HL-> it; ERR 10   Clobbers nothing else
BREAK:  CALL    POLL
        CPI     CCTLC
        RNZ
; BROKEN - he has: that key is done with, error 10
; In:  HL-> KEYB   Clobbers all
BROKEN: MVI     M,0
ERTAPE: DB      ERROR,ETAPE

; CRLF - ends the paper's line
; Clobbers A
CRLF:   CALL    PUTSI
        DB      CCR,CLF+80H
        RET

; PUTSI - prints the text that follows the call
; Clobbers A
PUTSI:  XTHL
        CALL    PUTS
        XTHL
        RET

; PUTS - prints a text whose last character has bit 7 set, or which ends with 00
; In:  HL-> it   Out: HL-> behind it   Clobbers A
PUTS:   MOV     A,M
        ORA     A
        RZ
        DB      PUTC            ; (without bit 7)
        INX     H
        JP      PUTS
        RET

; PUT2D - two decimal digits to the paper
; In:  A = them   Clobbers A
PUT2D:  PUSH    PSW
        RRC
        RRC
        RRC
        RRC
        CALL    PUT1D
        POP     PSW
; PUT1D - the lower one alone   Clobbers A
PUT1D:  ANI     0FH
        ORI     CZERO
        DB      PUTC
        RET
