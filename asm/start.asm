; start.asm - restarts, what becomes of a line that is understood, and reset
; Offers: ERROR PUTC NEXT EXPECT CALC PEEK CHKEND CHECK PUTC0 NEXT0 NEXT1 ERMEM ERSYN ADDA ERDATA
;         CHKEN0 SREM SFREE VARSUM
; Uses:   calc cut io lexer monitor parser repeat
; Room:   388 bytes, 396 with BRD51
;
; The DS lines fill each gap up to the next restart.  asm80 does not refuse a routine that
; grows past it; a test looks at the GAP labels.

; The restarts' bytes (equ.asm says why they are data)
ERROR   EQU     0CFH
PUTC    EQU     0D7H
NEXT    EQU     0DFH
EXPECT  EQU     0E7H
CALC    EQU     0EFH
PEEK    EQU     0F7H
CHKEND  EQU     0FFH

;! ERROR0 == 8 and PUTC0 == 10H and NEXT0 == 18H and EXPEC0 == 20H and PEEK0 == 30H and CHKEN0 == 38H -- the restarts go there
;! ERROR == 0C7H+8 and PUTC == 0C7H+10H and NEXT == 0C7H+18H and EXPECT == 0C7H+20H -- RST n is one byte
;! CALC == 0C7H+28H and PEEK == 0C7H+30H and CHKEND == 0C7H+38H -- RST n is one byte
; RST 0 - reset
        JMP     RESET

; CHECK - is the statement only parsed?
; In:  CHKF   Out: A = CHKF, Z: no, it works   Clobbers nothing else
CHECK:  LDA     CHKF
        ORA     A
        RET
GAP08:  DS      08H-$

; RST 1 - ERROR: the statement ends, with the error whose number follows the RST
ERROR0: POP     H
        MOV     A,M             ; A = number
        LXI     SP,STKTOP
        JMP     ERR
GAP10:  DS      10H-$

; RST 2 - PUTC: prints, and punches when the punch is on
; In:  A, whose bit 7 does not count   Clobbers nothing
PUTC0:  PUSH    PSW
        PUSH    H
        PUSH    B
        ANI     7FH
        JMP     PUTC1
GAP18:  DS      18H-$

; RST 3 - NEXT: takes a token
; In:  TXTP   Out: A = token, Z at the line's end; TXTP behind it   Clobbers HL
NEXT0:  DB      PEEK
NEXT1:  INX     H               ; (READI takes an item here, OPFLT a number)
        SHLD    TXTP
        RET

ERMEM:  DB      ERROR,EMEM
GAP20:  DS      20H-$

; RST 4 - EXPECT: takes a token, which must be the one that follows the RST
; In:  TXTP   Out: A = token; ERR 01   Clobbers HL
EXPEC0: DB      NEXT
        XTHL                    ; HL-> the byte behind the RST
        CMP     M
        INX     H
        XTHL
        RZ
ERSYN:  DB      ERROR,ESYN
GAP28:  DS      28H-$

; RST 5 - CALC: byte-code follows the RST
        JMP     CALC0

; ADDA - adds A to HL
; In:  A, HL   Out: HL   Clobbers A
ADDA:   ADD     L
        MOV     L,A
        RNC
        INR     H
        RET
GAP30:  DS      30H-$

; RST 6 - PEEK: looks at the next token
; In:  TXTP   Out: A = token, Z at the line's end; HL = TXTP   Clobbers nothing else
PEEK0:  LHLD    TXTP
        MOV     A,M
        ORA     A
        RET

ERDATA: DB      ERROR,EDATA
GAP38:  DS      38H-$

; RST 7 - CHKEND: the statement must end here; in check mode it is left for good
; In:  TXTP, CHKF   Out: ERR 01   Clobbers A, HL
CHKEN0: DB      EXPECT,TEOL
; SREM - statement: REM text
SREM:   CALL    CHECK
        RZ
; (fall into CHKED)

; CHKED - the line is understood: stores it or carries it out
; In:  at STKTOP-2: -> behind its tokens; the stack holds little more
CHKED:  LXI     H,TOKS
        SHLD    TXTP
        MOV     A,M
        CPI     TINPUT          ; in a program only: the answer would take the line's place
        JZ      ERSYN
        DCR     A               ; TFLT?
        JNZ     DIRECT
; (fall into STORE)

; STORE - puts the line into the program, or takes it out; to READY
; In:  LINUM = its number, STKTOP-2
STORE:  MVI     L,STMT0 & 255
        SHLD    TXTP
        DB      NEXT
        CPI     TRUN
        JNC     ERSYN           ; commands do not go into a program
        XRA     A               ; it is listed, unseen (OUTSEL = 0, from GETLIN): is it a line
        STA     COLS            ; that LOAD takes?
        MVI     L,LINUM & 255   ; (HL-> STMT0+1, from NEXT)
        CALL    LINE1
        CALL    LISTLN
        LDA     COLS
        CPI     126+2+1         ; CR and LF count
        JNC     ERMEM
        MVI     L,(LINUM-1) & 255 ; the record's head takes the place of the number token
        LDA     STKTOP-2        ; low byte of -> behind the tokens
        SUI     (STMT0+1) & 255
        JZ      STOR1           ; the number alone: no record
        ADI     STMT0+1-LINUM+2 ; (the check byte comes to the tokens)
STOR1:  MOV     M,A
        MOV     C,A             ; C = length
        PUSH    H
        DCR     A
        CALL    SUMREC
        MOV     M,A             ; (no record: somewhere in the stack's free room)
        LHLD    LINUM
        XCHG
        CALL    FINDLN          ; HL-> its place
        JZ      STOR2           ; A = length of the line that it replaces
        XRA     A
STOR2:  PUSH    H
        MOV     D,H
        MOV     E,L
        CALL    ADDA
        XCHG                    ; DE-> the program behind it
        MOV     A,C
        CALL    ADDA            ; HL-> where that must go
        LDA     PEND
        SUB     E
        MOV     C,A
        LDA     PEND+1
        SBB     D
        MOV     B,A             ; BC = its length - 1
        PUSH    D
        PUSH    H
        DAD     B
        XCHG
        LHLD    VBOT
        XCHG
        CALL    CPHD
        JNC     ERMEM
        SHLD    PEND
        POP     H
        POP     D
        CALL    CPHD
        JC      STOR3           ; down: first byte first
        DAD     B               ; up: last byte first
        XCHG
        DAD     B
        XCHG
STOR3:  LDAX    D               ; (CY: down)
        MOV     M,A
        JC      STOR4
        DCX     D
        DCX     D
        DCX     H
        DCX     H
STOR4:  INX     D
        INX     H
        DCX     B
        MOV     A,B             ; below 0?
        INR     A
        JNZ     STOR3
        POP     H
        POP     D
        LDAX    D
        ORA     A
        CNZ     COPY
        CALL    RTNEW           ; the route buffer began at PEND
        CALL    CLRPTR
        JMP     READY

; RESET - readies the ports (8 bits, 2 stop bits, clock / 16), finds the RAM, keeps what is
;         sound in it, signs on
RESET:  LXI     SP,STKTOP
        CALL    CALINI
        IF      BRD51
        LXI     H,IOTAB
RESE1:  MOV     A,M
        INX     H
        OUT     TTYST
        OUT     PUNST
        CPI     37H
        JNZ     RESE1
        ELSE
        MVI     A,03H           ; reset
        OUT     TTYST
        OUT     PUNST
        MVI     A,11H
        OUT     TTYST
        OUT     PUNST
        ENDIF
        LXI     H,0
        SHLD    KEYB            ; and LOADF
        DCR     H
        SHLD    CHKF            ; no check mode, paper on
        MVI     H,RAM/256
RESE2:  MOV     A,M             ; does this page keep what is written?
        INR     A
        INR     M
        CMP     M
        JNZ     RESE3
        DCR     M
        INR     H
        MOV     A,H             ; the last page of all memory is left alone, so that no sum of an
        INR     A               ; address and a length passes 0FFFFH
        JNZ     RESE2
RESE3:  DCX     H               ; HL-> last byte of RAM
        XCHG
        LHLD    VTOP
        CALL    CPHD
        XCHG
        SHLD    VTOP
        CNZ     NEW1            ; VTOP is the signature: not the RAM that it was
        LXI     H,PROG
RESE4:  SHLD    PEND            ; sound so far
        MOV     A,M
        ORA     A
        JZ      RESE5
        CALL    SUMREC
        ORA     A
        JZ      RESE4
        LHLD    PEND
        MVI     M,0             ; from here on it is lost
        CALL    PUTSI
        DB      CCR,CLF,"DAMAGE",0C4H ; DAMAGED
RESE5:  CALL    VARSUM
        CNZ     CLEAR
        CALL    CLEAR1          ; (once more does no harm)
        CALL    PUTSI
        DB      CCR,CLF,"SKG",0A0H
        DB      SKIP1           ; skips the RST 7
; (fall into SFREE)

; SFREE - command: FREE
SFREE:  DB      CHKEND
        LHLD    PEND
        XCHG
        LHLD    VBOT
        MOV     A,L
        SUB     E
        MOV     L,A
        MOV     A,H
        SBB     D
        MOV     H,A
        JMP     ERR4

        IF      BRD51
IOTAB:  DB      0,0,0           ; ends whatever the 8251 was waiting for
        DB      40H             ; reset
        DB      0CEH            ; mode
        DB      37H             ; command: transmitter and receiver on
        ENDIF

; SUMREC - check sum: a sound record of the program sums up to 0
; In:  HL-> bytes, A = how many   Out: A = 0 less their sum; HL behind; B = 0
SUMREC: MOV     B,A
        XRA     A
SUMR1:  SUB     M               ; (VARSUM goes on with its sum here)
        INX     H
        DCR     B
        JNZ     SUMR1
        RET

; VARSUM - check sum of the variables, to VSUM
; Out: Z when it is the same as last time, HL-> VSUM   Clobbers A, B, C
VARSUM: LHLD    VBOT
        XRA     A
        SUB     L
        MOV     B,A             ; to the end of the page
VARS1:  CALL    SUMR1           ; then whole pages: B = 0
        MOV     C,A
        LDA     VTOP+1
        INR     A
        CMP     H
        MOV     A,C
        JNZ     VARS1
        LXI     H,VSUM
        CMP     M
        MOV     M,A
        RET
