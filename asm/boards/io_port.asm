; io_port.asm - the teletype's characters, through the board's ports
; Offers: PAPER POLL
; Uses:   [more] [ports] [punch]
; Room:   60 bytes

; PAPER - prints a character, which the punch gets too when it is on
; In:  B = it, C = OUTSEL   Clobbers A, C, HL
PAPER:  MOV     A,C
        ORA     A
        RZ
        CALL    POLL
        IN      TTYST
        ANI     TXRDY
        JZ      PAPER
        MOV     A,B
        OUT     TTYDT
        DCR     C
        JZ      BDPUN
        RET

; POLL - looks at the keyboard; while ctrl-S holds, does not come back.  A second key finds the first one's place
;        taken: CLOST then stands there
; Out: A = KEYB, HL-> it, Z: it is a break that has been waiting   Clobbers nothing else
POLL:   LXI     H,KEYB
POLL1:  MOV     A,M
        CPI     CCTLC
        RZ                      ; a break waits
        IN      TTYST
        ANI     RXRDY+RXOVR
        JZ      POLL2
        ANI     RXOVR
        ORA     M
        ANI     NOKEY
        IN      TTYDT
        CALL    RXKEY
        MOV     M,A
POLL2:  MOV     A,M
        CPI     CXOFF
        RNZ
        JMP     POLL1
