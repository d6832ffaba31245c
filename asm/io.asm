; io.asm - teletype, punch and reader
; Offers: TTYST PUNDT PUNST RXRDY PUTC1 PUNON SSAVE PUNOFF PAPON BREAK ERTAPE CRLF PUTSI PUTS
; Uses:   monitor start
; Room:   127 bytes
;
; OUTSEL says where characters go: 0 nowhere, 1 paper and punch, else paper.
; KEYB holds the last key typed ahead, 0 when there is none.  ctrl-C stays in it
; until BREAK looks at it, ctrl-S holds all output until the next key.

        IF      BRD51
TTYDT   EQU     10H             ; teletype: data
TTYST   EQU     11H             ; teletype: status
PUNDT   EQU     12H             ; punch and reader: data
PUNST   EQU     13H             ; punch and reader: status
TXRDY   EQU     01H             ; transmitter empty
RXRDY   EQU     02H             ; receiver full
        ELSE
TTYST   EQU     10H
TTYDT   EQU     11H
PUNST   EQU     12H
PUNDT   EQU     13H
RXRDY   EQU     01H
TXRDY   EQU     02H
        ENDIF

; PUTC1 - the work of RST 2
; In:  A = character; PSW, HL and BC on the stack   Clobbers nothing
PUTC1:  MOV     B,A
        LXI     H,LASTC
        MOV     M,A
        DCX     H
        INR     M               ; COLS
        JNZ     PUTC3
        DCR     M               ; (255 and more are all the same)
PUTC3:  DCX     H
        MOV     A,M             ; OUTSEL
        MOV     C,A
        ORA     A
        JZ      PUTC2
PAPER:  CALL    POLL
        IN      TTYST
        ANI     TXRDY
        JZ      PAPER
        MOV     A,B
        OUT     TTYDT
        IF      PTTY
        ELSE
        DCR     C
        JNZ     PUTC2
PUNCH:  IN      PUNST
        ANI     TXRDY
        JZ      PUNCH
        MOV     A,B
        OUT     PUNDT
        ENDIF
PUTC2:  POP     B
        POP     H
        POP     PSW
        RET

; POLL - looks at the keyboard; while ctrl-S holds, does not come back
; Out: A = KEYB, HL-> it   Clobbers nothing else
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

; PUNON - what is printed from here on is punched too
; Clobbers A
        IF      PTTY
PUNON:  MVI     A,CDC2
        DB      PUTC
        ELSE
PUNON:  MVI     A,1
        STA     OUTSEL
        ENDIF
        RET

; SSAVE - command: SAVE, SAVE n, SAVE n,m; ctrl-Z tells LOAD where the tape ends
SSAVE:  CALL    PUNON           ; (also when it is only parsed: nothing is printed then)
        CALL    SLIST
        MVI     A,CEOF
        DB      PUTC
; (fall into PUNOFF)

; PUNOFF - punch off; the place for a break, since the block is complete
; PAPON - paper on: the same where the punch is not the teletype's
; Clobbers A, HL
PUNOFF:
        IF      PTTY
        MVI     A,CDC4
        DB      PUTC
        ENDIF
PAPON:  MVI     A,2
        STA     OUTSEL
; (fall into BREAK)

; BREAK - has the operator broken in?
; Out: A = KEYB, HL-> it; ERR 10   Clobbers nothing else
BREAK:  CALL    POLL
        CPI     CCTLC
        RNZ
        MVI     M,0
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
