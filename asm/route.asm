; route.asm - the route: what is kept of it, what the calculator does for it, and the wire's travel along an element
; Offers: CKIND NKIND HELDN RITEMS RELEMS RLASTP RFSTP RFILW RTURN RNAMED FITN FITSM RCORN RKEPT
;         NEEDEL NOFIL XSEEN XSENS XJC XONEL XNORM XNORMS XCHDA XXING PASSP ADVANC
; Uses:   [post] calc consts float geom parser start value
; Room:   241 bytes
;
; cut.asm says what a route is, and how it is cut.  Distances up to 1 um (QMU) are taken as none.

CKIND   EQU MCUR        ; kinds of the elements
NKIND   EQU MNEXT
HELDN   EQU CWORK+3     ; low byte: -> behind the last place in HELD, 0 = no span of FIT is held back
RITEMS  EQU CWORK+5     ; items written so far: 0 = no route is open, 1, 2 = more
RELEMS  EQU CWORK+6     ; elements of them that did not merge: 0, 1, 2 = more
RLASTP  EQU CWORK+7     ; 1 = last item was a point
RFSTP   EQU CWORK+8     ; 1 = first item was a point
RFILW   EQU CWORK+9     ; not 0 = a fillet waits
RTURN   EQU CWORK+10    ; not 0 = the corner to come turns right
RNAMED  EQU CWORK+11    ; not 0 = the corner to come is named by P
FITN    EQU CWORK+12    ; 0 = no curve; 1 = one of FIT has begun, 2 = its last node waits for the next
FITSM   EQU CWORK+13    ; not 0 = the last element is an arc of that curve, up to P; 1 = it was entered at a corner
RCORN   EQU CWORK+33    ; where the first element was left: two floats
RKEPT   EQU MREG+335    ; behind the registers: element kept while a fillet goes first

;! RTURN == RFILW+1 and RNAMED == RTURN+1 -- CORDON and FILLET write two cells at once
;! RFSTP == RLASTP+1 -- SAMEL compares two cells that it takes at once
;! RBFULL == CLOSED+1 and FITSM == FITN+1 -- RBNEW and FITEND clear two cells at once
;! MKX+PLCSIZ <= MREG+320 and RKEPT+ELSIZE <= LINBUF -- copies stay in their rooms
;! RELEMS/100H == RCORN/100H -- JOINED changes the low byte alone

; NEEDEL - demands that the route has an element
; Out: A = RELEMS, not 0; ERR 06   Clobbers nothing else
NEEDEL: LDA     RELEMS
        ORA     A
        RNZ
        DB      ERROR,EGEOM

; NOFIL - demands that no fillet waits
; Out: A = 0; ERR 06   Clobbers nothing else
NOFIL:  LDA     RFILW
        ORA     A
        RZ
        DB      ERROR,EGEOM

; Operations of the calculator that the route adds

; QSEEN: x1 y1 x2 y2 -> a, b = these places as seen from the centre of C
XSEEN:  DB      LC1,QSUB,SB1,LC0,QSUB,SB0 ; x1 y1
        DB      LC1,QSUB,SA1,LC0,QSUB,QTOA+QRET ; -
; QSENS: may the element a be offset? Negative: it is a circle that would lose its sense
XSENS:  DB      QJC
        DB      XSENS1-$
        DB      QABS+QRET       ; >= 0
XSENS1: DB      LA2,QADD        ; r'
        DB      LA2,QSIG        ; +-r'          as r has it
        DB      QNEAR,QSUB+QRET ; +-r'-eps
; QJC: jumps when a is a circle, not a line
XJC:    LDA     VKIND
        SUI     KLIN            ; CY: jump
        JMP     OJCY
; QONEL: demands that the point b lies on the element a; along a fitted curve it does
XONEL:  LDA     FITSM
        ORA     A
        RNZ
        DB      CALC,QJC
        DB      XONEL1-$
        DB      QDOT,LA2        ; place gamma
        DB      QJMP
        DB      XONEL2-$
XONEL1: DB      QDIF,QHYP       ; distance
        DB      LA2,QABS        ; distance |r|
XONEL2: DB      QE6D+QRET       ; -
; QNORM: a0 a1 = right normal of the element a at the point b
XNORM:  DB      QJC
        DB      XNORM1-$
        DB      QRET
XNORM1: DB      QDIF            ; dx dy
        DB      LA2,QSIG,QSWP   ; +-dy dx
        DB      LA2,QSIG,QSWP   ; +-dx +-dy
        DB      QUNIT+QRET      ; -
; QNORMS: a0 a1, b0 b1 = right normals of C and N at K = b; negative when they differ by less than
; 0.001 rad
XNORMS: DB      QNA,QNORM,QVEC ; x y
        DB      QCA,QNORM,QSB   ; -
        DB      QCRS,QABS,QMU,QSUB+QRET ; |sine|-0.001

; QCHDA: x y -> dx dy: from a0 a1 to x y, times t0
XCHDA:  DB      LA1,QSUB,LT0,QMUL,QSWP ; dy x
        DB      LA0,QSUB,LT0,QMUL,QSWP+QRET ; dx dy

; QXING: a0 a1 = the crossing of C offset by O1 and N offset by O2, as RTURN says; ERR 06
XXING:  DB      QNA        ; -
        DB      LA2,LO2,QADD,SA2 ; -
        DB      QXCH,QCA        ; -             b = N
        DB      LA2,LO1,QADD,SA2,QEND ; -
        LDA     RTURN
        ORA     A
        CNZ     NEGVAL          ; -C*N = C*-N
        LDA     NKIND
        ANI     7FH
        MVI     C,RSTAR
        JMP     BINOPK

; PASSP - the wire travels C to K; the contour goes on from P, the corner as drawn
; In:  as ADVANC, P   Out: as ADVANC, D = P   Clobbers all
PASSP:  CALL    ADVANC
        DB      CALC,LPX,SDX,LPY,SDY ; -
PASSP1: DB      QRET            ; (for WRAP too)

; ADVANC - the wire travels C to the corner K
; In:  C, A, K, W; RELEMS = 0: C is closed, no travel means the whole circle
; Out: A = K, W; ERR 06 when K lies behind A on a line   Clobbers all
ADVANC: DB      CALC,LKX,LAX,QSUB ; dx
        DB      LKY,LAY,QSUB,QSB ; -            b = chord
        DB      QCA,QJC         ; -
        DB      ADVAN2-$
        DB      QCRS            ; forward
        DB      QMU,QADD,QE6N   ; -
        DB      QEND            ; -
        JMP     MOVE
ADVAN2: DB      LB0,LB1,QFAR    ; negative: within 1 um
        DB      QJN             ; -
        DB      ADVAN3-$
        DB      LAX,LA0,QSUB,LAY,LA1,QSUB,QSA ; -       a = A from the centre
        DB      QCRS,LC2,QSIG   ; s             < 0: more than half a turn
        DB      ST3,QEND        ; -
        CALL    WRAP
        JMP     ARC
ADVAN3: DB      QM1,ST3,QEND    ; -             the corner is the entry place
        LDA     RELEMS
        ORA     A
        JZ      ARC             ; the whole circle
        DB      CALC,Q1,ST3,QEND ; -            no travel
; (fall into WRAP)

; WRAP - demands that the travel on the circle C, from A to K, differs by no more than half a turn from the travel
;        as drawn, from D to P: else the wire would leave the element out, or run round all of it
; In:  C, A, K, D, P; t3 negative when the wire travels more than half a turn   Out: ERR 06
; Clobbers all
; The wire's travel is that as drawn, and what its ends are moved by, when the moves are no more than half a turn
; together: then the sum of their cosines is not negative.  That of the travels may be wrapped around: when one is less
; than half a turn, the other one more.  The angles from D to K and from A to P have the mean of the two travels.  It is
; nearer to half a turn than to none when nothing is wrapped around: then the sum of their cosines is not positive.
; Within 1 um of none the travel as drawn is none, but at a corner that a point names, where TL is 0, a whole turn.
WRAP:   LDA     FITSM           ; (between two arcs of one curve corners stay: they touch; not so where the first begins)
        CPI     2
        RNC
        DB      CALC,LDX,LDY,LAX,LAY,QSEEN,QDOT ; c
        DB      LPX,LPY,LKX,LKY,QSEEN,QDOT,QADD,QE6N ; -
        DB      LPX,LPY,LDX,LDY,QSEEN,QCRS,LC2,QSIG ; -s   s: sine of the travel as drawn, times the radii
        DB      LC2,QABS,QMU,LTL,QNEG,QSIG,QMUL,QADD ; -s
        DB      LT3,QSIG,QJN    ; -             both in one half
        DB      PASSP1-$
        DB      LDX,LDY,LKX,LKY,QSEEN,QDOT ; c
        DB      LAX,LAY,LPX,LPY,QSEEN,QDOT ; c c
        DB      QADD,QNEG,QE6N+QRET ; -
