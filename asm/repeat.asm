; repeat.asm - routes that are cut again: SYM, REP, RECUT; and SCALE
; Offers: SREP SSYM SRECUT SSCALE
; Uses:   calc consts cut ends fit float geom io parser route start value
; Room:   330 bytes
;
; The route buffer lies between the program and the variables, from PEND+1 to RBEND:
; 16 bytes an item, its kind (bit 7: a turn to the right leads to it) and its value in
; the scale of the tape.  It goes on from BACK to the next route, for RECUT.  A route
; that has outgrown it (RBFULL) is cut all the same.

RSRC    EQU CWORK+22    ; -> item to feed
RSTOP   EQU CWORK+24    ; -> behind the last one
RJOIN   EQU CWORK+26    ; turn at the corner that SYM or REP makes
ROP     EQU CWORK+27    ; operation on the items: rank
ROPK    EQU CWORK+28    ; and kind of its right operand
RCOUNT  EQU CWORK+31    ; copies that are wanted

;! KNUM == 0 and KTURN == 4 -- SREP: of the kinds 1 to 3 all have bits that KTURN has not

; FETCH - an item of the buffer as the value
; In:  RSRC; bit 7 of A: its corner turns right   Out: a0 a1 a2, VKIND, RTURN
; Clobbers A, DE, HL
FETCH:  LXI     H,RTURN         ; (a fillet may have said so before)
        ANI     80H
        ORA     M
        MOV     M,A
        LHLD    RSRC
        XCHG
        JMP     GETREC

; IMAGE - feeds the item at RSRC, mirrored or turned
; In:  bit 7 of A: its corner turns right   Clobbers all
IMAGE0: XRA     A
IMAGE:  CALL    FETCH
        LDA     VKIND
        ORA     A
        JZ      IMAG1
        DB      CALC,LRA,LRT,QMUL,LRX,QSB ; -
        DB      LRY,SB2         ; -
        DB      QEND
        LHLD    ROP             ; L = rank, H = kind
        MOV     C,L
        MOV     A,H
        CALL    BINOPK
        JMP     ITEMT
IMAG1:  LDA     RFILW
        ORA     A
        RNZ                     ; one waits already
        JMP     ITEMT

; OPENRT - demands an open route that is in memory whole, prepares what is done to its items
; In:  HL = operation on them, a = its right operand (a2 not scaled yet)
; Out: ROP, RA RX RY, RT = 1, RSTOP, HL = its first item = RSRC; ERR 06, ERR 09   Clobbers all
OPENRT: SHLD    ROP
        DB      CALC,LA0,SRA,Q1,SRT,LA1,SRX ; -
        DB      LA2,QSCL,SRY,QEND ; -
        LDA     RITEMS
OPENR1: ORA     A               ; (SRECUT comes in here: all items from PEND on)
        JZ      ERGEO
        LDA     RBFULL
        ORA     A
        JNZ     ERMEM
        LHLD    RBEND
        SHLD    RSTOP
OPENR2: LHLD    PEND            ; (SREP comes in here: from PEND on)
        INX     H
        SHLD    RSRC
        RET

; STEP - to the next item
; Out: HL = RSRC, Z: that is RSTOP   Clobbers A, DE
STEP:   LXI     D,16
STEP1:  LHLD    RSRC            ; (for STEPB)
        DAD     D
        SHLD    RSRC
        XCHG
        LHLD    RSTOP
        XCHG
        JMP     CPHD

; JOINT - ends a curve, takes the ";" that SYM and REP may begin with
; Out: RJOIN   Clobbers all
JOINT:  CALL    FITEND
        DB      PEEK
        SUI     CSEMI
        SUI     1
        SBB     A               ; 0FFH for a ";", else 0
        STA     RJOIN
        RZ
        DB      NEXT
        RET

; SREP - statement: REP n, angle or rotation
SREP:   CALL    JOINT
        CALL    EVINT
        PUSH    H
        DB      EXPECT,CCOMMA
        CALL    EVAL
        DB      CHKEND
        POP     H
        SHLD    RCOUNT
        MOV     A,H
        ORA     L
        JZ      ERRNG
        LDA     VKIND
        ANI     0FFH-KTURN      ; a number (0) or a rotation (4)
        JNZ     ERKIND
        DB      CALC,LA1,QSCL,SA1,QEND ; -
        LXI     H,KTURN*256+2   ; #
        CALL    OPENRT
SREP2:  LHLD    RCOUNT
        DCX     H
        SHLD    RCOUNT
        MOV     A,H
        ORA     L
        RZ
        CALL    BREAK           ; (copies may need no block)
        CALL    OPENR2
        LDA     RJOIN
        DB      SKIP1           ; skips the MOV
SREP3:  MOV     A,M
        CALL    IMAGE
        CALL    STEP
        JNZ     SREP3
        DB      CALC,LRT,Q1,QADD,SRT,QEND ; -
        JMP     SREP2

; SSYM - statement: SYM line
; The items come last to first, each with the turn of the one behind it; a fillet stays
; behind a point and goes before an element, so that it is between two elements again.
SSYM:   CALL    JOINT
        MVI     A,KLIN
        CALL    EVKIND
        DB      CHKEND
        LXI     H,KLIN*256+7    ; /
        CALL    OPENRT
        LHLD    RSTOP
        SHLD    RSRC
SYM1:   CALL    STEPB
        XCHG
        LHLD    PEND
        CALL    CPHD
        RNC                     ; that was the first
        XCHG
        MOV     A,M
        ADD     A               ; 2 * kind
        JZ      SYM1            ; a fillet goes with the item before it
        CPI     2*KPNT
        PUSH    PSW
        CNZ     SYMFIL
        MOV     A,M
        LXI     H,RJOIN
        MOV     B,M
        MOV     M,A
        MOV     A,B
        CALL    IMAGE
        POP     PSW
        CZ      SYMFIL
        JMP     SYM1

; SYMFIL - feeds the item behind RSRC when it is a fillet
; Out: HL = RSRC, as it was   Clobbers all
SYMFIL: CALL    STEP
        JZ      STEPB
        MOV     A,M
        ADD     A
        CZ      IMAGE0
; (fall into STEPB)

; STEPB - to the item before
; Out: HL = RSRC   Clobbers A, DE
STEPB:  LXI     D,-16
        JMP     STEP1

; SRECUT - statement: RECUT
SRECUT: DB      CHKEND
        LDA     CLOSED
        CALL    OPENR1
SREC1:  MOV     A,M
        CALL    FETCH
        CALL    ITEMT           ; (noted again where it stands)
        CALL    STEP
        JNZ     SREC1
        JMP     GOBACK

; SSCALE - statement: SCALE number
SSCALE: CALL    EVNUM
        DB      CHKEND
        DB      CALC,LA0,QDUP,QSQRT,QDIV,QEND ; .     (the root refuses what is negative, the quotient 0)
        LDA     RITEMS
        ORA     A
        JNZ     ERGEO
        DB      CALC,LA0,SSC,QRET ; -
