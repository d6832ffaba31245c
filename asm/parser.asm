; parser.asm - expressions, names and variables
; Offers: EVAL OPFLT NEGVAL FIND ASSIGN SETREF RBNEW RBSET GETREF ERUNS PRVAL MORE EVINT EVPNT EVNUM
;         EVKIND ERKIND NOTURN FINT CMPNE
; Uses:   calc consts float geom io lexer start value
; Room:   585 bytes
;
; Grammar (tokens, equ.asm):
;   expression = operand { operator operand }      priorities of language.md, section 2
;   operand    = number | name | "(" expression ")" | "-" operand
;              | "+" operand | function operand
;   name       = two bytes | letter index, expression, "]"
;
; The current value stands in a0 a1 a2 (unused ones zero), its kind in
; VKIND.  A left operand waits on the 8080 stack, so that one look at the stack
; pointer bounds the depth.  In check mode (CHKF not zero) the same code runs but
; looks nothing up and computes nothing.
;
; A variable is its name (high byte, low byte), then one, two or three floats.
; The newest lies lowest, at VBOT; a zero byte at VTOP ends the list.

STKGAP  EQU BDSTK+64    ; stack bytes that the deepest operation may need

;! TINTF-TSQR == QINT-QSQRT -- OPFN: functions stand as in OPTAB (SQR SIN COS TG ATG ABS INT)
;! TK2 == TK1+1 and TK3 == TK1+2 and TK1 == TINTF+1 -- OPFN tells K1 K2 K3 from the others
;! CONTAB/100H == (CONTAB+10)/100H -- FIND changes the low byte alone for O and X
;! KPNT == KNUM+1 and KCIR == KPNT+1 and KLIN == KCIR+1 and KTURN == KLIN+1 -- SETK, KINDOF and BINOP count kinds

; EVAL - value of an expression; the outermost comma is left alone
; In:  TXTP -> its first token
; Out: a0 a1 a2, VKIND; TXTP -> behind it
; Clobbers all
EVAL:   MVI     A,1             ; an operator of rank 1 (comma) ends it
; (fall into EVALR)

; EVALR - value of an expression, up to an operator of rank A or looser
; In:  A = rank, TXTP -> first token
; Out: as EVAL   Clobbers all
EVALR:  PUSH    PSW
        CALL    OPND
EVA1:   DB      PEEK            ; PEEK
        LXI     H,OPCHRS
        MVI     C,7             ; C = rank; 0 when it is no operator
EVA2:   CMP     M
        JZ      EVA3
        INX     H
        DCR     C
        JNZ     EVA2
EVA3:   POP     PSW
        CMP     C
        RNC
        PUSH    PSW
        DB      NEXT            ; NEXT: take the operator
        LDA     VKIND
        MOV     B,A             ; B = left kind, C = rank
        LXI     H,-15
        DAD     SP
        SPHL
        CALL    PUTA            ; left value waits on the stack
        PUSH    B
        MOV     A,C
        CALL    EVALR
        CALL    XXCH            ; right value to b0 b1 b2
        POP     B
        LXI     H,0
        DAD     SP
        XCHG
        CALL    GETA            ; DE = stack before the left value
        XCHG
        SPHL
        CALL    BINOP
        JMP     EVA1

OPCHRS: DB      "/*-+:#,"       ; operators, tightest (rank 7) first

; OPND - value of one operand
; In:  TXTP -> its first token   Out: as EVAL   Clobbers all
OPND:   LXI     H,-STKLOW-STKGAP
        DAD     SP
        JNC     ERMEM           ; nested too deep
        DB      NEXT
        CPI     TFLT
        JZ      OPFLT
        CPI     CLPAR
        JZ      OPPAR
        CPI     CMINUS
        JZ      OPNEG
        CPI     CPLUS           ; changes nothing
        JZ      OPND
        CPI     TSQR
        JC      OPNAM
        CPI     TK3+1
        JNC     ERSYN
; (fall into OPFN)

; OPFN - a function of one operand
; In:  A = its token   Out: as EVAL   Clobbers all
OPFN:   PUSH    PSW
        CALL    OPND
        POP     B
        CALL    CHKRET
        MOV     A,B
        SUI     TK1
        JNC     OPK
        PUSH    B
        MVI     B,KNUM
        CALL    KINDIS          ; of a number
        DB      CALC,LA0,QEND   ; a
        POP     PSW
        SUI     TSQR-QSQRT      ; the number of its operation
        LXI     B,OPFN1
        JMP     CALOP
OPFN1:  DB      QTOA+QRET       ; -

; OPK - K1 K2 K3: canonical number A (0...2) of the value
; In:  A, a0 a1 a2, VKIND   Out: as EVAL; ERR 04   Clobbers all
OPK:    MOV     B,A
        INR     B               ; B = 1...3
        CALL    NOTURN
        ADD     A               ; a number (0) has none, a point (1) two, the others (2, 3)
        CMP     B               ; all three
        JC      ERKIND
OPK1:   DCR     B
        JZ      SETNUM
        LXI     D,MA+5          ; each comes one place down
        CALL    GETA
        JMP     OPK1

; OPPAR - an expression in parentheses; in it the comma is an operator
; In:  TXTP behind the first one   Out: as EVAL   Clobbers all
OPPAR:  XRA     A
        CALL    EVALR
        DB      EXPECT,CRPAR
        RET

; OPFLT - a number of five bytes
; In:  TXTP -> it   Out: as EVAL   Clobbers all
OPFLT:  DB      PEEK
        XCHG
        LXI     H,MA
        CALL    COPY5
        XCHG
        CALL    TAKEHL          ; TXTP = HL+1
        JMP     SETNUM

; OPNAM - value of a name
; In:  A = its first token   Out: as EVAL; ERR 03 when it has none   Clobbers all
OPNAM:  CALL    NAME
        CALL    KINDD
        CALL    CHECK
        JNZ     BINKND          ; (geom: the value is of kind B)
        CALL    FIND
        JC      ERUNS
        XCHG
        CALL    GETA            ; (all of them, whatever follows a shorter one)
        JMP     BINKND

; OPNEG - negates an operand
; In:  TXTP -> it   Out: as EVAL   Clobbers all
OPNEG:  CALL    OPND
; (fall into NEGVAL)

; NEGVAL - negates the value: of a circle the radius, else everything
; In:  a0 a1 a2, VKIND   Clobbers all
NEGVAL: CALL    CHKRET
        DB      CALC,LA2,QNEG,SA2,QEND ; -
        CALL    NOTURN
        CPI     KCIR
        RZ
        DB      CALC,LA0,QNEG,LA1,QNEG,QSA+QRET ; -

; NAME - a name with its subscript worked out
; In:  A = its first token, taken   Out: DE = name   Clobbers all
NAME:   MOV     D,A             ; (all of it when a byte follows)
        SUI     TNAME
        CPI     TSUB+14-TNAME
        JNC     ERSYN
        CPI     TSUB-TNAME
        JC      NAME1
        PUSH    PSW
        CALL    EVINT
        XCHG
        DB      EXPECT,CRBRK
        CALL    SUBCHK
        POP     PSW
        ADD     A               ; 4 times the letter's index ...
        ADD     A
        ADI     TNAME-4*(TSUB-TNAME)+256 ; ... and TNAME
        ORA     D
        MOV     D,A
        RET
NAME1:  DB      NEXT
        MOV     E,A
        RET

; KINDD - kind and size of the value of the name DE
; KINDOF - the same of the name whose high byte is in A, from the order of the letters
; Out: B = kind, C = bytes; A = the name's high byte   Clobbers nothing else
KINDD:  MOV     A,D
KINDOF: LXI     B,KNUM*256+5
        CPI     TNAME+20        ; A D R I J
        RC
        LXI     B,KPNT*256+10
        CPI     TNAME+32        ; P O V
        RC
        LXI     B,KCIR*256+15
        CPI     TNAME+44        ; C B T
        RC
        INR     B               ; S X Y
        RET

; FIND - looks a name up, the predefined ones last
; In:  DE = name
; Out: B = kind, C = bytes; CY clear: HL -> value.  CY set: it has none
; Clobbers A, BC, HL
FIND:   LHLD    VBOT
FIND1:  MOV     A,M
        ORA     A
        JZ      FIND3           ; the end
        CALL    KINDOF
        CMP     D
        INX     H
        MOV     A,M
        INX     H
        JNZ     FIND2
        CMP     E
        RZ
FIND2:  MVI     B,0
        DAD     B
        JMP     FIND1
FIND3:  CALL    KINDD
        INR     E               ; none in RAM: O, X and Y are constants
        DCR     E
        STC
        RNZ
        LXI     H,CONTAB
        CPI     TNAME+52        ; Y
        RZ
        MVI     L,(CONTAB+5) & 255
        CPI     TNAME+24        ; O
        RZ
        MVI     L,(CONTAB+10) & 255
        CPI     TNAME+48        ; X
        RZ
        STC
        RET

; ASSIGN - statement: name = expression
; In:  TXTP -> name   Clobbers all
ASSIGN: CALL    GETREF
        PUSH    D
        DB      EXPECT,CEQU
        CALL    EVAL
        POP     D
        DB      CHKEND
; (fall into SETREF)

; SETREF - gives a name the value
; In:  DE = name; a0 a1 a2, VKIND   Clobbers all
SETREF: CALL    FIND
        PUSH    PSW
        CALL    KINDIS
        POP     PSW
        JNC     SETR1
        PUSH    D
        LHLD    VBOT
        MOV     A,C
        CMA
        MOV     E,A
        MVI     D,0FFH          ; DE = -1 less the bytes of the value
        DAD     D
        DCX     H
        XCHG                    ; DE-> the new variable
        LHLD    RBEND           ; does it fit above the route buffer?
        CALL    CPHD
        JC      SETR2
        CALL    PAPON           ; (memory full is no wrong answer to INPUT)
        LXI     H,RBFULL        ; no: that is given up for it
        INR     M
        CALL    RBEMP
        CALL    CPHD
        JNC     ERMEM
SETR2:  XCHG
        POP     D
        SHLD    VBOT
        MOV     M,D
        INX     H
        MOV     M,E
        INX     H
SETR1:  MOV     A,C
        LXI     D,MA
        JMP     COPY

; RBNEW - forgets the route buffer, for a new route
; Clobbers HL
RBNEW:  LXI     H,0
        SHLD    CLOSED          ; and RBFULL
; (fall into RBEMP)

; RBEMP - empties the route buffer
; Clobbers HL
RBEMP:  LHLD    PEND
        INX     H
; (fall into RBSET)

; RBSET - the route buffer ends at HL
; In:  HL   Clobbers nothing
RBSET:  SHLD    RBEND
        RET

; GETREF - a name on the left side, or in READ and INPUT
; In:  TXTP -> name   Out: DE = name; ERR 03 for O, X, Y   Clobbers all
GETREF: DB      NEXT
        CALL    NAME
        CALL    CHKRET
        CALL    FIND
        RC
        MOV     A,H
        CPI     RAM/256
        RNC
ERUNS:  DB      ERROR,EUNSET

; PRVAL - prints the value: a number, or (x,y), (x,y,r), (alpha,beta,gamma)
; In:  a0 a1 a2, VKIND   Clobbers all
PRVAL:  CALL    CHKRET
        LXI     H,MA
        LXI     B,8*256+2       ; B = digits, C = floats
        CALL    NOTURN
        DCR     A
        JM      PRNUM
        JZ      PRV1            ; a point
        INR     C
PRV1:   MVI     A,CLPAR
PRV2:   DB      PUTC
        CALL    PRNUM
        MVI     A,CCOMMA
        DCR     C
        JNZ     PRV2
        MVI     A,CRPAR
        DB      PUTC
        RET

; MORE - in a list: takes the comma; where there is none the statement must end, and
;        the routine that called is left
; Clobbers A, HL
MORE:   DB      PEEK
        CPI     CCOMMA
        JZ      NEXT0
        POP     H
        DB      CHKEND
        RET

; EVINT - value of an expression that must be a whole number
; In:  TXTP -> it   Out: HL = 0...65535 (4 in check mode); ERR 05   Clobbers all
EVINT:  CALL    EVNUM
        RNZ
        CALL    NRINT
        JNZ     ERRNG
        LXI     H,MVB
        CALL    FTOI16
        RNC
        DB      ERROR,ERANGE

; EVPNT - value of an expression that must be a point
; EVNUM - of one that must be a number
; EVKIND - of one that must be of kind A
; In, Out: as EVAL, Z set but in check mode; ERR 04   Clobbers all
EVPNT:  MVI     A,KPNT
        DB      SKIP1           ; skips the XRA
EVNUM:  XRA     A
EVKIND: PUSH    PSW
        CALL    EVAL
        POP     B
        CALL    CHKRET
; (fall into KINDIS)

; KINDIS - demands that the value is of kind B
; In:  B, VKIND   Out: A = B, Z set   Clobbers nothing else
KINDIS: LDA     VKIND
        CMP     B
        RZ
ERKIND: DB      ERROR,EKIND

; NOTURN - demands that the value is no rotation
; In:  VKIND   Out: A = VKIND   Clobbers nothing else
NOTURN: LDA     VKIND
        CPI     KTURN
        RNZ
        DB      ERROR,EKIND

; FINT - INT (QINT): greatest whole number not above, nearly whole ones taken as whole
; In:  x = a0   Out: on the calculator's stack   Clobbers all
FINT:   CALL    NRINT
        JZ      FINT1
        DB      CALC,QFLR+QRET  ; whole
FINT1:  DB      CALC,QDRP,LB0,QRET ; whole

; NRINT - nearest whole number
; In:  a0   Out: b0 = it, Z set when a0 is nearly equal to it   Clobbers all
NRINT:  DB      CALC,LA0        ; a
        DB      QHALF,QADD      ; a+1/2
        DB      QFLR            ; b
        DB      QEND
; (fall into CMPNE)

; CMPNE - nearly-equal compare of a0 with b on the float stack
; In:  a0, b   Out: b0 = b; Z when they are closer than 1E-7 * max(1,|a|,|b|); else CY set
;      when a < b
; Clobbers all
CMPNE:  DB      CALC,SB0        ; -
        DB      LA0,LB0,QSUB    ; a-b
        DB      QDUP,ST0        ; a-b
        DB      QABS            ; |a-b|
        DB      LA0,QABS        ; |a-b| |a|
        DB      LB0,QABS,QMAX   ; |a-b| max
        DB      Q1,QMAX         ; |a-b| max
        DB      QNEAR,QMUL      ; |a-b| limit
        DB      QSUB            ; |a-b|-limit
        DB      QJN             ; -
        DB      CMPN1-$
        DB      QEND
        LDA     MT0+1
        ORI     1
        ADD     A               ; CY = sign: a < b; never zero
        RET
CMPN1:  DB      QEND            ;               (leaves A = 0, Z set)
        RET
