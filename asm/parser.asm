; parser.asm - expressions, names and variables
; Offers: EVAL EVNUM EVINT ASSIGN GETREF SETREF PRVAL CMPNE CLRVAR CHKRET,
;         COPY and the stubs ERSYN ERKIND ERRNG ERGEO ERMEM ERUNS
; Uses:   calc, float, geom (BINOP), monitor (CHKEND, the pointers)
; Room:   700 bytes
;
; Grammar (tokens, equ.asm):
;   expression = operand { operator operand }      priorities of language.md, 2
;   operand    = number | name | "(" expression ")" | "-" operand
;              | function operand
;   name       = two bytes | letter index, expression, "]"
;
; The value of the moment stands in a0 a1 a2 (unused ones zero), its kind in
; VKIND.  A left operand waits on the 8080 stack, so that one look at the stack
; pointer bounds the depth.  In check mode (CHKF not zero) the same code runs but
; looks nothing up and computes nothing.
;
; A variable is its name (high byte, low byte), then one, two or three floats.
; The newest lies lowest, at VBOT; a zero byte at VTOP ends the list.

VKIND   EQU CWORK       ; kind of the value in a0 a1 a2
RFUNC   EQU 8           ; rank of a function: tighter than any operator
STKROM  EQU 64          ; stack bytes that the deepest operation may need
SUBMAX  EQU 999         ; greatest subscript

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
EVA1:   RST     6               ; PEEK
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
        RST     3               ; NEXT: take the operator
        LDA     VKIND
        MOV     B,A             ; B = left kind, C = rank
        LXI     H,-16
        DAD     SP
        SPHL
        LXI     D,MA
        CALL    COPY15          ; left value waits on the stack
        PUSH    B
        MOV     A,C
        CALL    EVALR
        LXI     H,MB
        LXI     D,MA
        CALL    COPY15          ; right value to b0 b1 b2
        POP     B
        LXI     H,0
        DAD     SP
        XCHG
        LXI     H,MA
        CALL    COPY15
        INX     D               ; DE = stack before the left value
        XCHG
        SPHL
        CALL    BINOP
        JMP     EVA1

OPCHRS: DB      "/*-+:#,"       ; operators, tightest (rank 7) first

; COPY15 - copies a value (three floats)
; In:  DE -> from, HL -> to   Out: DE, HL behind   Clobbers A
COPY15: MVI     A,15
; (fall into COPY)

; COPY - copies A bytes
; In:  DE -> from, HL -> to, A = count   Out: DE, HL behind   Clobbers A
COPY:   PUSH    B
        MOV     B,A
COPY1:  LDAX    D
        MOV     M,A
        INX     D
        INX     H
        DCR     B
        JNZ     COPY1
        POP     B
        RET

; OPND - value of one operand
; In:  TXTP -> its first token   Out: as EVAL   Clobbers all
OPND:   LXI     H,-STKLOW-STKROM
        DAD     SP
        JNC     ERMEM           ; nested too deep
        RST     3
        CPI     TFLT
        JZ      OPFLT
        CPI     CLPAR
        JZ      OPPAR
        CPI     CMINUS
        JZ      OPNEG
        CPI     TSQR
        JC      OPNAM
        CPI     TK3+1
        JNC     ERSYN
; (fall into OPFN)

; OPFN - a function of one operand
; In:  A = its token   Out: as EVAL   Clobbers all
OPFN:   PUSH    PSW
        CALL    OPND
        POP     PSW
        MOV     C,A
        CALL    CHKRET
        MOV     A,C
        SUI     TK1
        JNC     OPK
        CALL    NUMBER
        LXI     H,MA
        XCHG
        LXI     H,FNTAB
        MOV     A,C
        SUI     TSQR
; (fall into JTAB)

; JTAB - jumps to entry A of a table of addresses
; In:  A = index, HL -> table   Out: the entry runs with HL = the DE given
; Clobbers A, BC, DE
JTAB:   ADD     A
        MOV     C,A
        MVI     B,0
        DAD     B
        MOV     C,M
        INX     H
        MOV     B,M
        PUSH    B
        XCHG
        RET

FNTAB:  DW      FSQR,FSIN,FCOS,FTG,FATG,FABS,FINT       ; TSQR ... TINTF

; OPK - K1 K2 K3: canonical number A (0...2) of the value
OPK:    MOV     B,A
        LDA     VKIND
        CPI     KNUM
        JZ      ERKIND
        CPI     KTURN
        JZ      ERKIND
        SUI     KPNT
        JNZ     OPK1
        MVI     A,1
        CMP     B
        JC      ERKIND          ; a point has two
OPK1:   LXI     H,MA
        LXI     D,5
OPK2:   DCR     B
        JM      OPK3
        DAD     D
        JMP     OPK2
OPK3:   XCHG
        LXI     H,MA
        CALL    COPY5
        JMP     SETNUM

; OPPAR - an expression in parentheses; in it the comma is an operator
OPPAR:  XRA     A
        CALL    EVALR
        RST     4
        DB      CRPAR
        RET

; OPFLT - a number of five bytes
OPFLT:  LHLD    TXTP
        XCHG
        LXI     H,MA
        CALL    COPY5
        XCHG
        SHLD    TXTP
; (fall into SETNUM)

; SETNUM - makes the value a number: a1 and a2 zero
; Out: VKIND   Clobbers A, B, HL
SETNUM: XRA     A
; (fall into SETK)

; SETK - makes the value one of kind A: the floats that it has not are zero
; In:  A = kind   Out: VKIND   Clobbers A, B, HL
SETK:   STA     VKIND
        LXI     H,MA+10
        MVI     B,5
        CPI     KPNT
        JZ      SETK1
        RNC                     ; three floats
        LXI     H,MA+5
        MVI     B,10
SETK1:  MVI     M,0
        INX     H
        DCR     B
        JNZ     SETK1
        RET

; OPNAM - value of a name
; In:  A = its first token   Out: as EVAL; ERR 03 when it has none
OPNAM:  CALL    NAME
        MOV     A,D
        CALL    KINDOF
        MOV     A,B
        STA     VKIND
        CALL    CHKRET
        CALL    FIND
        JC      ERUNS
        XCHG
        LXI     H,MA
        MOV     A,C
        CALL    COPY
        LDA     VKIND
        JMP     SETK

; OPNEG - negates an operand
OPNEG:  CALL    OPND
; (fall into NEGVAL)

; NEGVAL - negates the value: of a circle the radius, else everything
; In:  a0 a1 a2, VKIND   Clobbers all
NEGVAL: CALL    CHKRET
        LDA     VKIND
        CPI     KTURN
        JZ      ERKIND
        LXI     H,MA+10
        CPI     KCIR
        JZ      FNEG
        CALL    FNEG
        LXI     H,MA+5
        CALL    FNEG
        LXI     H,MA
        JMP     FNEG

; NAME - a name with its subscript worked out
; In:  A = its first token, taken   Out: DE = name   Clobbers all
NAME:   CPI     TNAME
        JC      ERSYN
        CPI     TSUB
        JC      NAME1
        CPI     TSUB+14
        JNC     ERSYN
        SUI     TSUB
        PUSH    PSW
        CALL    EVINT
        PUSH    H
        RST     4
        DB      CRBRK
        POP     D
        LXI     H,-SUBMAX-1
        DAD     D
        JC      ERRNG
        POP     PSW
        ADD     A
        ADD     A
        ORI     TNAME
        ORA     D
        MOV     D,A
        RET
NAME1:  MOV     D,A
        RST     3
        MOV     E,A
        RET

; KINDOF - kind and size of a name's value, from the order of the letters
; In:  A = name, high byte   Out: B = kind, C = bytes; A kept
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

; FIND - looks a name up, the predefined ones first
; In:  DE = name
; Out: CY clear: HL -> value, C = its bytes.  CY set: it has none
; Clobbers A, BC, HL
FIND:   LXI     H,PREDEF
        CALL    FIND1
        RNC
        LHLD    VBOT
FIND1:  MOV     A,M
        ORA     A
        STC
        RZ                      ; the end
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

; O, X and Y, as variables in ROM
PREDEF: DB      TNAME+24,0      ; O = (0,0)
        DB      0,0,0,0,0, 0,0,0,0,0
        DB      TNAME+48,0      ; X = (0,-1,0)
        DB      0,0,0,0,0
        DB      81H,80H,0,0,0
        DB      0,0,0,0,0
        DB      TNAME+52,0      ; Y = (1,0,0)
        DB      81H,0,0,0,0
        DB      0,0,0,0,0, 0,0,0,0,0
        DB      0

; ASSIGN - statement: name = expression
; In:  TXTP -> name   Clobbers all
ASSIGN: CALL    GETREF
        PUSH    D
        RST     4
        DB      CEQU
        CALL    EVAL
        POP     D
        CALL    CHKEND
; (fall into SETREF)

; SETREF - gives a name the value
; In:  DE = name; a0 a1 a2, VKIND   Clobbers all
SETREF: CALL    CHKRET
        MOV     A,D
        CALL    KINDOF
        LDA     VKIND
        CMP     B
        JNZ     ERKIND
        CALL    FIND
        JC      SETR2
SETR1:  MOV     A,C
        LXI     D,MA
        JMP     COPY
SETR2:  MOV     A,D
        CALL    KINDOF
        MVI     B,-1 & 255
        MOV     A,C
        CMA
        DCR     A
        PUSH    B
        MOV     C,A             ; BC = -(bytes + 2)
        LHLD    VBOT
        DAD     B
        CALL    ROOM            ; does it fit above the route buffer?
        SHLD    VBOT
        POP     B
        MOV     M,D
        INX     H
        MOV     M,E
        INX     H
        JMP     SETR1

; CLRVAR - forgets all variables
; In:  VTOP = last byte of RAM   Out: VBOT   Clobbers HL
CLRVAR: LHLD    VTOP
        SHLD    VBOT
        MVI     M,0
        RET

; GETREF - a name on the left side, or in READ and INPUT
; In:  TXTP -> name   Out: DE = name; ERR 03 for O, X, Y   Clobbers all
GETREF: RST     3
        CALL    NAME
        CALL    CHKRET
        CALL    FIND
        MOV     A,H
        CPI     RAM/256
        RNC
ERUNS:  RST     1
        DB      EUNSET

; PRVAL - prints the value: a number, or (x,y), (x,y,r), (alpha,beta,gamma)
; In:  a0 a1 a2, VKIND   Clobbers all
PRVAL:  LXI     H,MA
        MVI     B,8
        LDA     VKIND
        ORA     A
        JZ      DECOUT
        CPI     KTURN
        JZ      ERKIND
        MVI     C,2
        CPI     KPNT
        JZ      PRV1
        INR     C
PRV1:   MVI     A,CLPAR
PRV2:   RST     2
        PUSH    B
        PUSH    H
        MVI     B,8
        CALL    DECOUT
        POP     H
        POP     B
        LXI     D,5
        DAD     D
        MVI     A,CCOMMA
        DCR     C
        JNZ     PRV2
        MVI     A,CRPAR
        RST     2
        RET

; EVINT - value of an expression that must be a whole number
; In:  TXTP -> it   Out: HL = 0...65535 (0 in check mode); ERR 05   Clobbers all
EVINT:  CALL    EVNUM
        LXI     H,0
        LDA     CHKF
        ORA     A
        RNZ
        CALL    NRINT
        JNZ     ERRNG
        LXI     H,MB
        CALL    FTOI16
        RNC
ERRNG:  RST     1
        DB      ERANGE

; EVNUM - value of an expression that must be a number
; In, Out: as EVAL; ERR 04   Clobbers all
EVNUM:  CALL    EVAL
; (fall into NUMBER)

; NUMBER - demands that the value is a number
; In:  VKIND   Clobbers A
NUMBER: CALL    CHKRET
        LDA     VKIND
        ORA     A
        RZ
ERKIND: RST     1
        DB      EKIND
ERSYN:  RST     1
        DB      ESYN
ERMEM:  RST     1
        DB      EMEM
ERGEO:  RST     1
        DB      EGEOM

; CHKRET - in check mode leaves the routine that called it
; In:  CHKF   Clobbers A (HL in check mode)
CHKRET: LDA     CHKF
        ORA     A
        RZ
        POP     H
        RET

; FINT - INT: greatest whole number not above, nearly whole ones taken as whole
; In:  a0   Out: a0   Clobbers all
FINT:   CALL    NRINT
        LXI     H,MA
        JNZ     FFLR
        LXI     D,MB
        JMP     COPY5

; NRINT - nearest whole number
; In:  a0   Out: b0 = it, Z set when a0 is nearly equal to it   Clobbers all
NRINT:  RST     5
        DB      LA0             ; a
        DB      QHALF,QADD      ; a+1/2
        DB      QFLR,SB0        ; -
        DB      QEND
; (fall into CMPNE)

; CMPNE - nearly-equal compare of a0 and b0
; In:  a0, b0
; Out: Z when they are closer than 1E-7 * max(1,|a0|,|b0|); else CY set when a0 < b0
; Clobbers all
CMPNE:  RST     5
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
        LXI     H,MT0
        CALL    FSGN            ; A = 0FFH when a < b, else 1
        ADD     A               ; CY = a < b; never zero
        RET
CMPN1:  DB      QEND
        XRA     A
        RET
