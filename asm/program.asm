; program.asm - the lines of the program: how they are kept, their numbers, LIST
; Offers: STORE FINDLN PLINE LOADDE SUMREC SUMON LINENO OPTLN LNEND SLIST
; Uses:   [punch] float lexer monitor parser start value
; Room:   265 bytes
;
; A program line: length of the record, line number (low byte first), tokens, 00, a byte
; that makes the sum of all 0 (checked at reset).  A zero length ends the program; PEND->
; it.

;! LINUM == TOKS+4 and STMT0 == TOKS+6 -- the record's head lies over the number's token

; STORE - puts the line into the program, or takes it out
; In:  LINUM = its number, at STKTOP-2: -> behind its tokens, H = TOKS/256   Out: ERR 01, ERR 09   Clobbers all
STORE:  MVI     L,STMT0 & 255
        SHLD    TXTP
        DB      NEXT
        CPI     TRUN
        JNC     ERSYN           ; commands do not go into a program
        XRA     A               ; it is listed, unseen (OUTSEL = 0, from GETLIN): is it a line
        STA     COLS            ; that LOAD takes?
        MVI     L,LINUM & 255   ; (HL-> STMT0+1, from NEXT)
        CALL    LOADDE
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
        CMP     C
        JZ      READY           ; nothing to take out: nothing is done
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
        RET

; FINDLN - finds a line
; In:  DE = number
; Out: HL-> the first line with that number or a higher one, or the end; Z: it is that
;      number, A = length of its record   Clobbers A, HL
FINDLN: LXI     H,PROG
        XRA     A
FIND1L: CALL    ADDA
        MOV     A,M
        SUI     1
        RC                      ; (Z clear)
        PUSH    H
        INX     H
        MOV     A,M
        INX     H
        MOV     H,M
        MOV     L,A
        CALL    CPHD
        POP     H
        MOV     A,M
        JC      FIND1L
        RET

; PLINE - takes the head of a program line
; In:  HL-> its record   Out: DE = number, HL-> tokens, A = bytes from there to the next
;      record; CY: the program ends here   Clobbers nothing else
PLINE:  MOV     A,M
        SUI     3
        RC
        INX     H
; LOADDE - takes a number of two bytes
; In:  HL -> it   Out: DE, HL behind   Clobbers nothing else
LOADDE: MOV     E,M
        INX     H
        MOV     D,M
        INX     H
        RET

; SUMREC - check sum: a sound record of the program sums up to 0
; In:  HL-> bytes, A = how many   Out: A = 0 less their sum; HL behind; B = 0   Clobbers nothing else
SUMREC: MOV     B,A
        XRA     A
; SUMON - goes on with a sum (keep.asm)
; In:  HL-> bytes, B = how many (0: 256), A = what the sum is taken from   Out: as SUMREC   Clobbers nothing else
SUMON:  SUB     M
        INX     H
        DCR     B
        JNZ     SUMON
        RET

; LINENO - takes a line number
; In:  TXTP   Out: HL = number, 0...65535; ERR 01   Clobbers all
LINENO: DB      EXPECT,TFLT
        CALL    OPFLT
        LXI     H,MA
        CALL    FTOI16
        RNC
        DB      ERROR,ESYN

; OPTLN - takes a line number, if there is one, and demands the statement's end
; Out: DE = number, else 0   Clobbers all
OPTLN:  DB      PEEK
        LXI     H,0
        JZ      LNEND1
; (fall into LNEND)

; LNEND - takes a line number and demands the statement's end
; Out: DE = number   Clobbers all
LNEND:  CALL    LINENO
LNEND1: XCHG                    ; (OPTLN comes in here with HL = 0: no number)
        DB      CHKEND
        RET

; SLIST - command: LIST, LIST n, LIST n,m
SLIST:  DB      PEEK
        LXI     H,-1            ; HL = last line to list
        LXI     D,0             ; DE = first
        JZ      SLIS2
        CALL    LINENO
        PUSH    H
        DB      PEEK
        POP     H
        PUSH    H               ; one number: that line
        JZ      SLIS1
        DB      EXPECT,CCOMMA
        CALL    LINENO
SLIS1:  POP     D
SLIS2:  PUSH    H
        DB      CHKEND
        CALL    FINDLN
SLIS3:  CALL    PLINE
        POP     B               ; last
        RC
        MOV     A,C
        SUB     E
        MOV     A,B
        SBB     D
        RC
        PUSH    B
        CALL    LISTLN
        CALL    LINGAP
        INX     H               ; check byte
        JMP     SLIS3
