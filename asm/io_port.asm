; io_port.asm - the teletype's characters, through the board's ports
; Offers: PAPER POLL
; Uses:   drive io_6850 io_8251 io_ended io_tty
; Room:   44 bytes

; PAPER - prints a character, which the punch gets too when it is on
; In:  B = it, C = OUTSEL   Clobbers A, C, HL
PAPER:  CALL    POLL
        IN      TTYST
        ANI     TXRDY
        JZ      PAPER
        MOV     A,B
        OUT     TTYDT
        DCR     C
        JZ      BDPUN
        RET

; POLL - looks at the keyboard; while ctrl-S holds, does not come back
; Out: A = KEYB, HL-> it, Z: it is a break that has been waiting   Clobbers nothing else
POLL:   LXI     H,KEYB
POLL1:  MOV     A,M
        CPI     CCTLC
        RZ                      ; a break waits
        IN      TTYST
        ANI     RXRDY
        JZ      POLL2
        IN      TTYDT
        ANI     7FH
        MOV     M,A
POLL2:  MOV     A,M
        CPI     CXOFF
        RNZ
        JMP     POLL1
