; io.asm - teletype, punch and reader
; Offers: PUTC1 (of RST 2), PUTS PUTSI CRLF PRDEC, BREAK, PUNON PUNOFF,
;         GETLIN
; Uses:   monitor (the cells), float (DECOUT FITOF)
; Room:   280 bytes
;
; OUTSEL says where characters go: bit 0 paper, bit 1 punch.
; KEYB holds the last key typed ahead, 0 when there is none.  ctrl-C stays in it
; until somebody asks (BREAK), ctrl-S holds all output until the next key.
; In a line, a control character that is no editing key means nothing.

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
CBEL    EQU     07H
WAIT2   EQU     18000           ; turns of INCH1 in two seconds (110 us each)

; PUTC1 - the work of RST 2
; In:  A = B = character; PSW, HL and BC on the stack   Clobbers nothing
PUTC1:  LDA     OUTSEL
        RAR
        JNC     PUTC2
        MOV     A,B
        STA     LASTC
PAPER:  CALL    POLL
        IN      TTYST
        ANI     TXRDY
        JZ      PAPER
        MOV     A,B
        OUT     TTYDT
        IF      PTTY
PUTC2:
        ELSE
        LDA     OUTSEL
        RAR
PUTC2:  RAR
        JNC     PUTC3
PUNCH:  CALL    POLL
        IN      PUNST
        ANI     TXRDY
        JZ      PUNCH
        MOV     A,B
        OUT     PUNDT
        ENDIF
PUTC3:  POP     B
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
        RST     2
        RET
        ELSE
PUNON:  MVI     A,3
        STA     OUTSEL
        RET
        ENDIF

; PUNOFF - punch off; the place for a break, since the block is complete
; Clobbers A, HL
        IF      PTTY
PUNOFF: MVI     A,CDC4
        RST     2
        ELSE
PUNOFF: MVI     A,1
        STA     OUTSEL
        ENDIF
; (fall into BREAK)

; BREAK - has the operator broken in?
; Out: A = KEYB, HL-> it; ERR 10   Clobbers nothing else
BREAK:  CALL    POLL
        CPI     CCTLC
        RNZ
        MVI     M,0
ERTAPE: RST     1
        DB      ETAPE

; CRLF - ends the paper's line
; Clobbers A
CRLF:   MVI     A,CCR
        RST     2
        MVI     A,CLF
        RST     2
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
        ANI     7FH
        RZ
        RST     2
        MOV     A,M
        INX     H
        ORA     A
        JP      PUTS
        RET

; PRDEC - prints a whole number
; In:  HL = number   Clobbers all, and t0
PRDEC:  LXI     D,MT0
        PUSH    D
        CALL    FITOF
        POP     H
        MVI     B,8
        JMP     DECOUT

; INCHR - waits for the next character, from the reader in LOAD, else from the teletype
; Out: A; ctrl-Z when the reader has stopped   Clobbers DE, HL
INCHR:  LXI     D,WAIT2
INCH1:  CALL    BREAK
        LDA     LOADF
        ORA     A
        JZ      INCH2
        DCX     D
        MOV     A,D
        ORA     E
        MVI     A,CEOF
        RZ
        IF      PTTY
        ELSE
        MVI     M,0             ; keys do not count
        IN      PUNST
        ANI     RXRDY
        JZ      INCH1
        IN      PUNDT
        MOV     M,A
        ENDIF
INCH2:  MOV     A,M
        ANI     7FH
        JZ      INCH1
        MVI     M,0
        RET

; GETLIN - reads a line into LINBUF, 00 behind it
; Out: ERR 09 when it is too long; to READY at the end of the tape   Clobbers all
GETL1:  CALL    CRLF            ; ctrl-U: again
GETLIN: LXI     H,LINBUF
GETL2:  PUSH    H
        CALL    INCHR
        POP     H
        CPI     CEOF
        JZ      GETL6
        CPI     CCR
        JZ      GETL5
        CPI     CLF
        JZ      GETL5
        CPI     CCTLU
        JZ      GETL1
        CPI     CRUB
        JZ      GETL4
        CPI     CBS
        JZ      GETL4
        CPI     CBLANK
        JC      GETL2
        MOV     M,A
        INR     L               ; (LINBUF ends with a page)
        JNZ     GETL3
        DCR     L               ; full: stays, so that the line is refused
        MVI     A,CBEL
GETL3:  RST     2
        JMP     GETL2
GETL4:  LDA     LOADF           ; take one back; a tape's RUBOUTs mean nothing
        ORA     A
        JNZ     GETL2
        MOV     A,L
        CPI     LINBUF & 255
        JZ      GETL2
        DCR     L
        CALL    PUTSI
        DB      CBS,CBLANK,CBS+80H
        JMP     GETL2
GETL5:  MVI     M,0
        CALL    CRLF
        INR     L
        RNZ
        JMP     ERMEM
GETL6:  MOV     A,L             ; the tape ends: at a line's start?
        CPI     LINBUF & 255
        JNZ     ERTAPE
        IF      PTTY
        MVI     A,CXOFF         ; the teletype's reader off
        RST     2
        ENDIF
        XRA     A
        STA     LOADF
        JMP     READY
