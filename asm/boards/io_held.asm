; io_held.asm - the teletype's characters, through the board's ports; KEYB takes what the reader sends, too, when lines come from there
; Offers: PAPER POLL
; Uses:   [ports] [punch] start
; Room:   67 bytes

; PAPER - prints a character, which the punch gets too when it is on; where nothing is printed it only looks who sends
; In:  B = it, C = OUTSEL   Clobbers A, C, HL
PAPER:  CALL    POLL
        MOV     A,C
        ORA     A
        RZ
        IN      TTYST
        ANI     TXRDY
        JZ      PAPER
        MOV     A,B
        OUT     TTYDT
        DCR     C
        JZ      BDPUN
        RET

; POLL - looks at the keyboard, and at the reader when lines come from there; while ctrl-S holds, does not come back.
;        At the prompt a character waits in the receiver while KEYB is taken; not so while a statement works, since it may be a break: there
;        CLOST takes the place of both
; Out: A = KEYB, HL-> it, Z: it is a break that has been waiting   Clobbers nothing else
POLL:   LXI     H,KEYB
        MOV     A,M
        CPI     CCTLC
        RZ                      ; a break waits
        ORA     A
        JZ      POLL1
        CALL    CHECK
        JNZ     POLL3
POLL1:  IN      TTYST
        ANI     RXRDY+RXOVR
        JZ      POLL2
        ANI     RXOVR
        ADD     A               ; (out of the way of NOKEY)
        ORA     M
        ANI     NOKEY
        IN      TTYDT
        CALL    RXKEY
        MOV     M,A
POLL2:  CALL    TAPEIN
POLL3:  MOV     A,M
        CPI     CXOFF
        RNZ
        JMP     POLL1
