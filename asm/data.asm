; data.asm - values come and go: PRINT, DATA, READ, RESTORE, INPUT
; Offers: SPRINT SDATA SREST SETDAT SREAD SINPUT ASKAGN
; Uses:   calc io lexer parser program start value
; Room:   187 bytes

;! PROG/100H > (TOKS+0FFH)/100H -- READI3 tells an answer to INPUT from an item of the program by its page

; SPRINT - statement: PRINT item, item ...
SPRINT: LXI     H,CRLF
        PUSH    H               ; comes last
        DB      PEEK
        JZ      CHKEN0
SPRI1:  DB      PEEK
        CPI     CQUOTE
        JZ      SPRI3
        CALL    EVAL
        CALL    PRVAL
SPRI2:  CALL    MORE
        MVI     A,CBLANK
        DB      PUTC
        JMP     SPRI1
SPRI3:  DB      NEXT            ; the quote
SPRI4:  DB      NEXT
        JZ      ERSYN           ; no second quote
        CPI     CQUOTE
        JZ      SPRI2
        DB      PUTC
        JMP     SPRI4

; SDATA - statement: DATA expression, ...: nothing, until READ comes
SDATA:  CALL    CHECK
        RZ
SDAT1:  CALL    EVAL
        CALL    MORE
        JMP     SDAT1

; SREST - statement: RESTORE, RESTORE n
SREST:  CALL    OPTLN
        CALL    FINDLN
; SETDAT - DATA goes on at a line (CLRPTR ends here, too)
; In:  HL -> the line   Clobbers HL
SETDAT: DCX     H
        DCX     H
SETDA1: SHLD    DATP            ; (READI3 comes in here with the place behind an item)
        RET

; SREAD - statement: READ name, ...
SREAD:  CALL    GETREF
        CALL    READI
        CALL    MORE
        JMP     SREAD

; READI - gives a name the next DATA item
; In:  DE = name; ERR 08   Clobbers all
READI:  CALL    CHKRET
        PUSH    D
        DB      PEEK            ; HL = TXTP
        PUSH    H
        LHLD    DATP
        MOV     A,M
        CPI     CCOMMA
        JZ      READI2
        MVI     A,2             ; over the 00 and the check byte
READI1: CALL    ADDA
        CALL    PLINE
        JC      ERDATA
        MOV     B,A
        MOV     A,M
        CPI     TDATA
        MOV     A,B
        JNZ     READI1
READI2: CALL    TAKEHL          ; TXTP = HL+1
        CALL    EVAL
; (fall into READI3)

; READI3 - ends READI and ASK; the stack keeps what it holds for ASKAGN until all is well, and an item is not used up
; In:  on the stack: TXTP, name; a0 a1 a2, VKIND; TXTP behind the item or the answer   Out: paper on   Clobbers all
READI3: POP     H
        POP     D
        PUSH    D
        PUSH    H
        CALL    SETREF
        DB      PEEK
        MOV     A,H
        CPI     PROG/256
        CNC     SETDA1          ; (an answer lies in TOKS)
        POP     H
        SHLD    TXTP
        POP     H
        JMP     PAPON

; SINPUT - statement: INPUT name, ..., in a program only
SINPUT: CALL    GETREF
        CALL    ASK
        CALL    MORE
        JMP     SINPUT

; ASKAGN - after a wrong answer: what ASK needs is still on the stack
; Out: as ASK   Clobbers all
ASKAGN: LXI     SP,STKTOP-8     ; RUNLP's return address, SINPUT's, name, TXTP
        CALL    PAPON
        CALL    CALINI          ; (the wrong answer's floats)
        JMP     ASK1

; ASK - asks for a value; a wrong answer is known by OUTSEL = 0 (GETLIN) in a statement
;       that works
; In:  DE = name   Clobbers all
;
; The stack while the answer is read and worked out, for ASKAGN and READI3:
;
;       STKTOP-2        return address of STMT, in RUNLP
;       STKTOP-4        return address of ASK, in SINPUT
;       STKTOP-6        the name
;       STKTOP-8        TXTP, behind the name in INPUT's list
ASK:    CALL    CHKRET
        PUSH    D
        DB      PEEK            ; HL = TXTP
        PUSH    H
ASK1:   CALL    PUTSI
        DB      "?",0A0H
        CALL    GETLIN
        CALL    EVAL
        DB      CHKEND
        JMP     READI3
