; cut.asm - how a CUT is cut: items that arrive become elements of the route
; Offers: SCUT ITEMT ITEMR ADDEL CORDON ITPNT PNTDON GETR SCALED XSCL
; Uses:   calc consts corner fit float geom parser round route start value
; Room:   351 bytes
;
; A route is a chain of oriented elements (lines, circles).  The wire travels the
; current element C, which it entered at A.  An item that arrives becomes the next
; element N; the corner K between C and N, each offset by its own R, ends C, whose
; segment goes out at once, and N becomes C.  Of points the last one, P, is kept:
; between two points comes a line, beside an element a point names the corner.  So
; two elements and a point are all the state of a route of any length; for closing
; it keeps the first element F, the place G where that was entered, and the first
; item Q when it was a point.  D is where the contour, as drawn, enters C, and P the corner as drawn.
;
; From the statement to the block:
;
;       SCUT            the values of the items, one by one                     here (parser, geom)
;       ITEM            scaled, with its offset; noted for SYM, REP and RECUT   here
;       ITPNT ITFIL     a point, a fillet's radius: wait for the element        here
;       ADDEL           the element N                                           here
;       FIRST           the first one: the wire goes from the start hole to it  corner
;       CORND           the corner P as drawn, when no point names it           corner
;       FILLET JOINED   the corner K as offset, with an arc between or without  corner
;       ADVANC          the wire travels C from A to K                          route
;       MOVE ARC        the block of a line, of an arc                          tape, arc_3b
;       ENDRT CLOSE     no item follows: an open end, or F once more            ends

RITCHK  EQU VKIND+2     ; kinds of the items of a CUT that is checked

; SCUT - statement: CUT item, item; item ...
SCUT:   CALL    FITEND
        MVI     A,9*KTURN       ; twice KTURN
        STA     RITCHK
        DB      PEEK
        CPI     CSEMI
        JNZ     SCUT2
SCUT1:  DB      NEXT
SCUT2:  PUSH    PSW             ; ";": the corner to come turns right
        CALL    EVAL
        POP     B
        CALL    ITEM
        DB      PEEK
        CPI     CSEMI
        JZ      SCUT1
        CALL    MORE
        JMP     SCUT2

; RECORD - notes an item in the route buffer
; In:  a0 a1 a2, VKIND, RTURN, RITEMS   Clobbers all
RECORD: LDA     RITEMS
        ORA     A
        CZ      RBNEW           ; a new route
        LDA     RBFULL
        ORA     A
        RNZ
        LHLD    RBEND
        PUSH    H
        LXI     D,16
        DAD     D
        XCHG
        LHLD    VBOT
        CALL    CPHD
        POP     H
        JC      RECO2
        LDA     RTURN
        ADI     0FFH            ; CY: right
        LDA     VKIND
        RAL
        RRC                     ; bit 7
        CALL    PUTVAL
        JMP     RBSET
RECO2:  LXI     H,RBFULL
        INR     M
        RET

; ITEM - takes one item into the route
; In:  a0 a1 a2, VKIND, B = token in front of it   Clobbers all (A, B in check mode)
ITEM:   CALL    CHECK
        JNZ     ITCHK
        MOV     A,B
        CPI     CSEMI
        JNZ     ITEM1
        STA     RTURN
ITEM1:  CALL    NOTURN
        CALL    SCALED
; ITEMT - the same for an item in the scale of the tape   Clobbers all
ITEMT:  CALL    GETR
; ITEMR - the same with the offset in NR   Clobbers all
ITEMR:  CALL    RECORD
        LDA     VKIND
        ORA     A
        JZ      ITFIL
        STA     RMOVED
        CPI     KPNT
        JZ      ITPNT
; (fall into ITELM)

; ITELM - a line or circle
; In:  A = its kind; a0 a1 a2, NR   Clobbers all
ITELM:  CALL    PUTN
; (fall into ADDEL)

; ADDEL - the element N follows: corner or merging, fillet.  When the last item was a point, that
;         names the corner
; In:  N; RLASTP, RTURN, RFILW, FI; first element: RFSTP, P or H
; Out: ERR 06 when the point is not on N   Clobbers all
ADDEL:  LDA     RLASTP
        STA     RNAMED
        ORA     A
        JZ      ADDEL1
        DB      CALC,QPTOK      ; -
        DB      QNA,QONEL,QEND  ; -             (leaves A = 0)
ADDEL1: CALL    ITDONE
        LXI     H,CORDON
        PUSH    H               ; comes last
        LDA     RELEMS
        ORA     A
        JZ      FIRST
        LDA     RNAMED
        ORA     A
        CZ      SAMEC
        RZ                      ; the same curve goes on: no corner
        CALL    OFFCHK
        LDA     RNAMED
        ORA     A
        CZ      CORND
        LDA     RFILW
        ORA     A
        JNZ     FILLET
        JMP     JOINED

; CORDON - the corner to come is not described yet; TL is as `*` has it
; Clobbers all
CORDON: LXI     H,0
        SHLD    RFILW           ; and RTURN
        DB      CALC,QMU,STL,QRET ; -

; ITCHK - in check mode: refuses a fillet that the line itself shows to have no place: after
;         another one, and between an element and a point
; In:  VKIND, KTURN when the line does not show it; RITCHK   Out: RITCHK; ERR 01   Clobbers A, B, HL
ITCHK:  LXI     H,VKIND
        MOV     B,M
        INX     H
        INX     H               ; RITCHK: kinds of the last items, three bits each
        MOV     A,M
        ADD     A
        ADD     A
        ADD     A
        ORA     B
        MOV     M,A
        ANI     3FH             ; number, number
        JZ      ERSYN
        MOV     A,M
        ANI     0BFH            ; circle (2) or line (3), number, point
        CPI     81H
        RNZ
        DB      ERROR,ESYN

; ITFIL - a fillet radius
; In:  a0   Out: FI; ERR 05, ERR 06   Clobbers all
ITFIL:  DB      CALC,LA0,QDUP,QDIV,QEND ; 1     (the quotient refuses 0)
        CALL    NOFIL           ; two in a row
        CALL    NEEDEL          ; before or at the entry (leaves A not 0)
        STA     RFILW
        DB      CALC,LA0,QMUL,SFI ; -
ITPN4:  DB      QRET            ; (for ITPNT too)

; ITPNT - a point
; In:  a0 a1, NR   Clobbers all
ITPNT:  DB      CALC,QVEC,SJY,SJX ; -
        DB      QXCH,Q0,SB2,Q0,SA2,QEND ; -     b = J
        LDA     RLASTP
        ORA     A
        JNZ     ITPN2
        LDA     RITEMS
        ORA     A
        JZ      ITPN1
        CALL    NOFIL           ; a fillet between an element and a point
        DB      CALC,QCA,QONEL  ; -
        DB      QJMP
        DB      ITPN3-$
ITPN1:  DB      CALC            ; the first item
        DB      LJX,SQX,LJY,SQY ; -
        DB      LNR,SQO,QJMP    ; -
        DB      ITPN3-$
ITPN2:  DB      CALC,LPX,LPY,QSA ; -
        DB      QDIF,QFAR       ; negative: within 1 um, the same point
        DB      QJN
        DB      ITPN4-$
        DB      QEND
        CALL    BELT            ; the line from P to J
        MVI     A,KLIN+80H      ; (bit 7: it passes its corners for certain)
        CALL    ITELM
; PNTDON - the point J is the last item
; In:  J   Out: P = J   Clobbers all
PNTDON: DB      CALC
ITPN3:  DB      LJX,SPX,LJY,SPY ; -
        DB      QEND            ;               (leaves A = 0)
        INR     A
; (fall into ITDONE)

; ITDONE - notes that an item was written
; In:  A = 1 for a point, 0 for an element   Clobbers HL
ITDONE: STA     RLASTP
        LXI     H,RITEMS
        INR     M
        DCR     M
        MVI     M,2             ; (Z stays)
        RNZ
        DCR     M               ; it is the first one
        STA     RFSTP
        RET

; GETR - the present R, the offset; 0 where it was not set
; Out: NR   Clobbers A, BC, DE, HL
GETR:   LXI     D,NAMER
        CALL    FIND            ; when there is none: HL -> a 0 in CONTAB
        XCHG
        LXI     H,MNR
        JMP     COPY5

; SCALED - the value in the scale of the tape
; In:  a0 a1 a2, VKIND   Out: a0 a1 a2   Clobbers all
SCALED: DB      CALC,LA2,QSCL,SA2 ; -
        DB      QJC             ; -             (points too)
        DB      SCAL1-$
        DB      QRET
SCAL1:  DB      LA0,QSCL,LA1,QSCL,QSA+QRET ; -
; QSCL: a number in the scale of the tape
XSCL:   DB      LSC,QMUL+QRET   ; x
