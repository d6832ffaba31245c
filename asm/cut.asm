; cut.asm - the route: from items to corners, fillets and closing
; Offers: HELDN RITEMS RFILW RTURN FITN FITSM RUNINI RTNEW SCUT ITEM2 ITEM3 POSIT GETR SCALED CPYEL
;         CPYPL RTDON1 ENDRT SFROM ROUTER XTRAV XSENS XJC XONEL XNORM XNORMS XCHDA XXING SBACK
;         SBACK1
; Uses:   arc_3b arc_iso arc_nodrift calc consts fit float geom grid iso parser start tape value
; Room:   1317 bytes
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
; Distances up to 1 um (QMU) are taken as none.

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
FITSM   EQU CWORK+13    ; not 0 = the last element is an arc of that curve, up to P
RCORN   EQU CWORK+33    ; where the first element was left: two floats
RKEPT   EQU CWORK+45    ; element kept while a fillet goes first
RITCHK  EQU VKIND+2     ; kinds of the items of a CUT that is checked

;! RTURN == RFILW+1 and RNAMED == RTURN+1 -- CORDON and FILLET clear two cells at once
;! RBFULL == CLOSED+1 and FITSM == FITN+1 -- RBNEW and FITEND clear two cells at once
;! MKX+PLCSIZ <= MREG+320 and RKEPT+ELSIZE <= FWORK -- copies stay in their rooms
;! RELEMS/100H == RCORN/100H -- JOINED changes the low byte alone

; RUNINI - the state in which a run starts: wire at O, scale 1, no route
; Clobbers all
RUNINI: DB      CALC,Q1,SSC,QEND ; -
        LXI     H,RUNCEL        ; (tape.asm)
        MVI     B,RUNLEN
        CALL    RTDON1
; (fall into RTNEW)

; RTNEW - forgets the open route and the route buffer
; Clobbers all
RTNEW:  CALL    CORDON
        CALL    RTDONE
; (fall into RBNEW)

; RBNEW - forgets the route buffer, for a new route
; Clobbers HL
RBNEW:  LXI     H,0
        SHLD    CLOSED          ; and RBFULL
        JMP     RBEMP

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
        SHLD    RBEND
        RET
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
; ITEM2 - the same for an item in the scale of the tape   Clobbers all
ITEM2:  CALL    GETR
; ITEM3 - the same with the offset in NR   Clobbers all
ITEM3:  CALL    RECORD
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
        DB      CALC,LPX,LPY,QTOK ; -
        DB      QNA,QONEL,QEND  ; -             (leaves A = 0)
ADDEL1: CALL    ITDONE
        LDA     RELEMS
        ORA     A
        JZ      FIRST
        LDA     RNAMED
        ORA     A
        JNZ     ADDEL2
        CALL    SAMEC
        JZ      CORDON          ; the same curve goes on: no corner
ADDEL2: DB      CALC,QEPS,STL,QEND ; -             a corner is no `*`: curves that do cross do so
        CALL    OFFCHK
        LDA     RNAMED
        ORA     A
        JNZ     ADDEL3
        CALL    CORND
        DB      CALC,LKX,SPX,LKY,SPY,QEND ; -    P = the corner as drawn
ADDEL3: LDA     RFILW
        ORA     A
        CNZ     FILLET
        CALL    JOINED
; (fall into CORDON)

; CORDON - the corner to come is not described yet; TL is as `*` has it
; Clobbers all
CORDON: LXI     H,0
        SHLD    RFILW           ; and RTURN
        SHLD    RTURN           ; and RNAMED
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
ITFIL:  CALL    POSIT
        CALL    NEEDEL          ; before or at the entry
        CALL    NOFIL           ; two in a row (leaves A = 0)
        INR     A
        STA     RFILW
        DB      CALC,LA0,SFI    ; -
ITPN4:  DB      QRET            ; (for ITPNT too)

; POSIT - demands that the value is a positive number
; In:  a0   Out: A = 0; ERR 05   Clobbers HL
POSIT:  LXI     H,MA
        CALL    FSGN
        DCR     A
        RZ
        DB      ERROR,ERANGE

; NEEDEL - demands that the route has an element
; Out: ERR 06   Clobbers A
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

; ITPNT - a point
; In:  a0 a1, NR   Clobbers all
ITPNT:  DB      CALC,LA0,SJX,LA1,SJY ; -
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
ITPN2:  DB      CALC,LPX,SA0,LPY,SA1 ; -
        DB      QDIF,QFAR       ; negative: within 1 um, the same point
        DB      QJN
        DB      ITPN4-$
        DB      QEND
        CALL    BELT            ; the line from P to J
        MVI     A,KLIN+80H      ; (bit 7: it passes its corners for certain)
        CALL    ITELM
ITPN5:  DB      CALC            ; (CLOSE comes in here)
ITPN3:  DB      LJX,SPX,LJY,SPY ; -
        DB      QEND            ;               (leaves A = 0)
        INR     A
; (fall into ITDONE)

; ITDONE - notes that an item was written
; In:  A = 1 for a point, 0 for an element   Clobbers A, B, HL
ITDONE: STA     RLASTP
        LXI     H,RITEMS
        MOV     B,M
        MVI     M,2
        INR     B
        DCR     B
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
SCALED: DB      CALC,LA2,LSC,QMUL,SA2 ; -
        DB      QJC             ; -             (points too)
        DB      SCAL1-$
        DB      QRET
SCAL1:  DB      LA0,LSC,QMUL,SA0 ; -
        DB      LA1,LSC,QMUL,SA1 ; -
        DB      QRET

; JOINED - corner between C and N, C goes out, N is the current element
; In:  C, N, RTURN, RNAMED; P = the corner as drawn   Out: D = P   Clobbers all
JOINED: CALL    CORNER
        CALL    PASSP
        LXI     H,RELEMS
        MOV     A,M
        MVI     M,2
        DCR     A
        LXI     D,MKX
        MVI     L,RCORN&255     ; (in one page with RELEMS)
        CZ      CPYPL           ; the end of the first element is kept
; (fall into NTOC)

; NTOC - the next element becomes the current one
; Clobbers A, BC, DE, HL
NTOC:   LXI     H,MCUR
; (fall into NCOPY)

; NCOPY - copies the next element
; In:  HL -> to   Clobbers A, BC, DE, HL
NCOPY:  LXI     D,MNEXT
; (fall into CPYEL)

; CPYEL - copies an element
; In:  DE -> from, HL -> to   Out: DE, HL behind   Clobbers A, BC
CPYEL:  MVI     A,ELSIZE
        DB      SKIP2B          ; skips the MVI
; CPYPL - copies a place
; In:  DE -> from, HL -> to   Out: DE, HL behind   Clobbers A
CPYPL:  MVI     A,PLCSIZ
        JMP     COPY

; FILLET - puts the arc that rounds the corner between C and N before N
; In:  C, N, FI; RTURN, RNAMED   Out: C = the arc (or untouched when C and N run on
;      without a turn)   Clobbers all
; The arc turns as the corner does; its centre is where the parallels at its signed
; radius FI cross (SKG book, formula 9-7).
FILLET: DB      CALC,LPX,LPY,QTOK,QNORMS,QJN ; -
        DB      FILL9-$
        DB      LCR,LNR,QE6D    ; -
        DB      LFI,QCRS,QSIG,QNEG ; -fi
        DB      QDUP,SO1,SO2    ; -
        DB      QCA,LO1,QSENS,QE6N ; -
        DB      QNA,LO1,QSENS,QE6N ; -
        DB      QEND
        LDA     MO1+1           ; bit 7: sign, 1 for a left turn
        ORI     7FH
        INR     A
        MOV     L,A
        MVI     H,0
        SHLD    RTURN           ; and RNAMED
        LXI     H,RKEPT
        CALL    NCOPY
        DB      CALC,Q0,STL,QXING,QMU,STL ; -        a = centre of the arc, which touches both
        DB      QVEC,SB1,SB0    ; -             a = b = centre
        DB      LO1,QNEG,SA2,QEND ; -
        MVI     A,KCIR
        CALL    PUTN
        CALL    PASSED          ; its touching point comes before the corner
        CALL    OFFCHK
        CALL    JOINED
        LXI     D,RKEPT
; TON - an element becomes the next one (CLOSE calls it too)
; In:  DE -> element   Clobbers A, BC, DE, HL
TON:    LXI     H,MNEXT
        JMP     CPYEL
FILL9:  DB      QDOT,QE6N+QRET  ; -             straight on, or straight back

; PASSED - on the way along the circle C from its entry A, does the point T = b come before K?
;          All as seen from the centre
; In:  C, A, K, b   Out: ERR 06 when not (never on a line: ADVANC looks after that)
; Clobbers all, K too
; It does when the chords to T and K turn as C does.  Places within 1 um, on the wire's path, are one;
; when K is the entry a fillet has no room (FILLET comes with RFILW set, CLOSE without).
PASSED: DB      CALC,QCA,QJC    ; -
        DB      PASS1-$
        DB      QRET
PASS1:  DB      QNORM,QVEC      ; tx ty
        DB      LC2,LCR,QADD,ST0 ; tx ty                t0 = r of the wire's path
        DB      QCA,LKX,LKY,QTOK,QNORM,QVEC ; tx ty kx ky
        DB      QCA,LAX,LAY,QTOK,QNORM ; tx ty kx ky  a = of the entry
        DB      QCHDA,SB0,SB1   ; tx ty         b = chord to K
        DB      QCHDA,SA0,SA1   ; -             a = chord to T
        DB      QVEC,QFAR,QJN   ; -             T is the entry
        DB      PASS2-$
        DB      LB0,LB1,QFAR,QJN ; -            K is the entry
        DB      PASS3-$
        DB      QDIF,QFAR,QJN   ; -             T is K
        DB      PASS2-$
        DB      QCRS,LC2,QSIG,QE6N ; -
PASS2:  DB      QRET
PASS3:  DB      QEND
        JMP     NOFIL

; OFFCHK - demands that the offset leaves a circle N its sense
; Out: ERR 07   Clobbers all
OFFCHK: DB      CALC,QNA,LNR,QSENS,QJN ; -
        DB      OFFCH1-$
        DB      QRET
OFFCH1: DB      QEND
        DB      ERROR,EOFFS

; CORND - the corner between C and N as drawn
; In:  C, N, RTURN, RNAMED, P   Out: K   Clobbers all
CORND:  DB      CALC,Q0,Q0,QJMP ; 0 0
        DB      CORN0-$
; CORNER - the corner between C and N as offset
; In:  C, N, RTURN, RNAMED, P   Out: K, O1, O2   Clobbers all
CORNER: DB      CALC,LCR,LNR    ; o1 o2
CORN0:  DB      SO2,SO1,QEND    ; -
; CORNO - the corner between C and N offset by O1 and O2
; In:  C, N, O1, O2, RTURN, RNAMED, P   Out: K   Clobbers all
; A named one is P itself when there is no offset; else of the crossings the one nearest to P,
; where both run the same way through P, P moved R to the right.  Lines between points (bit 7 of
; their kind) are taken to pass P: gamma is rounded, and at a flat corner that would be magnified.
CORNO:  LDA     RNAMED
        ORA     A
        JZ      CROSS
        DB      CALC,LPX,LPY,QTOK ; -             K = P = b
        DB      LO1,QABS,LO2,QABS,QADD,QJZ ; -  no offset
        DB      CORN9-$
        DB      QEND
        LDA     FITSM
        ORA     A
        JNZ     CORN1
        DB      CALC,QNORMS,QJN ; -             a, b = right normals of C and N
        DB      NAMED1-$
        DB      QEND
        LDA     CKIND
        LXI     H,NKIND
        ANA     M
        JM      CORN2           ; two lines between points
        DB      CALC,Q0,STL,QEND ; -             crossings, however flat (A = 0)
        STA     RTURN
        CALL    CROSS           ; (QRET leaves A not 0)
        STA     RTURN
        DB      CALC,QXING      ; -
        DB      LPX,LA0,LPY,LA1,QWAY ; d2^2
        DB      LPX,LKX,LPY,LKY,QWAY ; d2^2 d1^2
        DB      QSUB,QJN        ; -
        DB      ATOK-$
CORN9:  DB      QRET
; a corner that no point names: the crossing
CROSS:  DB      CALC,QXING      ; -
ATOK:   DB      QVEC,QTOK+QRET  ; -
CORN2:  DB      CALC            ; as seen from P both pass at their offsets alone
        DB      LO1,SA2,LO2,SB2,QEND ; -
        CALL    SXS
        DB      CALC,LKX,SB0,LKY,SB1,Q1,QJMP ; 1
        DB      NAMED3-$
CORN1:  DB      CALC            ; between arcs of a curve: both run the same way, square to the radius
        DB      QCA,QDIF,SA1,SA0 ; -            a = from the centre to P
        DB      LCR,LNR,QE6D    ; -
        DB      LCR,LC2,QDIV,QJMP ; R/r
        DB      NAMED3-$
NAMED1: DB      QDOT,QE6N       ; -             there and back
        DB      LPX,LPY,QTOK    ; -
        DB      LCR,LNR,QE6D    ; -             no crossing any more
NAMED2: DB      LCR             ; R
NAMED3: DB      QXCH,QNEG,QALNG,QJMP ; -        b moved along a
        DB      ATOK-$

; FIRST - N is the first element: the wire goes to it
; In:  N, P or H   Out: C = F = N, K; it goes on to ENTER; ERR 07   Clobbers all
FIRST:  CALL    OFFCHK
        CALL    CORDON
        LXI     H,RELEMS
        INR     M
        CALL    NTOC
        LXI     H,MFIRST
        CALL    NCOPY
        LXI     H,FIRST1        ; goes on when K is known
        PUSH    H
        LDA     RFSTP           ; set when a point was written before
        ORA     A
        JNZ     PATC
; (fall into PLACE)

; PLACE - place on C, as offset, that is nearest to the start hole
; Out: K   Clobbers all
PLACE:  DB      CALC,LHX,LHY,QTOK ; -             b = K = H
        DB      QCA             ; -
        DB      LC2,LCR,QADD    ; g             gamma or r as offset
        DB      QJC             ; g
        DB      PLACE1-$
        DB      QDOT,QSUB       ; t0            as far to the right
        DB      QJMP
        DB      NAMED3-$
PLACE1: DB      QDIF,QFAR,QJN   ; r
        DB      PLACE2-$
        DB      QNORM           ; r
        DB      LC0,SB0,LC1,SB1,QJMP ; r        b = centre
        DB      NAMED3-$
PLACE2: DB      QABS,LC0,QADD,LC1,QTOK+QRET ; - the +X side

; FIRST1 - the wire goes to the entry K; the contour as drawn begins in the same direction from a centre
; In:  K   Out: D = G   Clobbers all
FIRST1: CALL    ENTER           ; (tape.asm)
        DB      CALC,LGX,SDX,LGY,SDY,QRET ; -

; PATC - place of the point P on C, as offset: P moved R to the right
; Out: K   Clobbers all
PATC:   DB      CALC,LPX,LPY,QTOK ; -             b = K = P
        DB      QCA,QNORM       ; -             a = right normal
        DB      QJMP
        DB      NAMED2-$

; SAMEF - is the last item N, which as written is the first element?   SAMEC - does N go on along C?
; Out: Z set when it is   Clobbers all
SAMEF:  LDA     RLASTP
        ORA     A
        RNZ
        MVI     E,MFIRST & 255
        DB      SKIP2           ; skips the MVI
SAMEC:  MVI     E,MCUR & 255
; (fall into SAME)

; SAME - are an element and N the same curve in the same direction?
; In:  E: low byte of -> C or F   Out: Z set when they are   Clobbers all
SAME:   MVI     D,MREG/256      ; (both are in the registers' first page)
        CALL    XNA1            ; a = the element
        LXI     H,MT0
        CALL    COPY15          ; t0 = its offset, (t1,t2) = where it was entered
        LDA     VKIND
        LXI     H,NKIND
        CMP     M
        RNZ
        DB      CALC,QXCH,QNA   ; -             a = N, b = the element
        DB      QJC
        DB      SAME2-$
        DB      QEPS,QSQ,QDIF,QSS,QSUB ; eps^2-angle^2
        DB      QJN             ; -
        DB      SAME9-$
        DB      LT1,SB0,LT2,SB1,QDOT ; place along N's normal
        DB      LA2,QSUB,LT0,QSUB ; off
        DB      QABS            ; |off|
SAME1:  DB      QMU,QSWP,QSUB   ; 1um-|off|
        DB      QJN             ; -
        DB      SAME9-$
        DB      QEND            ;               (leaves A = 0, Z set)
        RET
SAME2:  DB      QDIF,QHYP       ; distance of the centres
        DB      LA2,LB2,QSUB    ; distance dr
        DB      QABS,QMAX       ; greater
        DB      QJMP
        DB      SAME1-$
SAME9:  DB      QRET            ;               (leaves Z clear)

; SAMEL - is the last item, as written, the first one?
; Out: Z set when it is   Clobbers all
SAMEL:  LDA     RLASTP
        LXI     H,RFSTP
        CMP     M
        RNZ
        ORA     A
        JZ      SAMEF
        DB      CALC,LPX,LQX,LPY,LQY,QWAY ; distance^2
        DB      QSQRT           ; distance
        DB      QJMP
        DB      SAME1-$

; CLOSE - closes the route onto its first element, up to where it was entered
; Clobbers all
; A first point is the closing corner, written once more.
CLOSE:  LDA     RFSTP
        ORA     A
        JZ      CLOSE1
        DB      CALC,LQX,SA0,LQY,SA1 ; -
        DB      LQO,SNR,QEND    ; -
        CALL    ITPNT
        CALL    ITPN5           ; (also when the last point lay within 1 um of it)
        CALL    NOFIL           ; a fillet there
CLOSE1: LDA     RELEMS
        DCR     A
        JZ      CLOSE4
        CALL    SAMEF
        JZ      CLOSE3          ; the last element is the first again
        LXI     D,MFIRST
        CALL    TON
        CALL    ADDEL
CLOSE3: DB      CALC,LCR,LFR,QE6D ; -
        DB      LGX,LGY,QTOK,QEND ; -           b = G
        LXI     D,RCORN
        LXI     H,MKX
        CALL    CPYPL           ; K = end of the first element
        CALL    PASSED          ; the corner lies before the entry, not past it
        JMP     CLOSE7
CLOSE4: LDA     CKIND           ; one element alone
        CPI     KCIR
        JNZ     ERGEO           ; a line
        LDA     RLASTP
        ORA     A
        JZ      CLOSE6
        CALL    PATC            ; by way of the last point
        CALL    PASSP
CLOSE6: LXI     H,RELEMS
        DCR     M               ; at the entry still: ADVANC takes the whole circle
CLOSE7: CALL    NOFIL           ; there is no corner
        DB      CALC,LGX,SPX,LGY,SPY ; -        the entry is the same, drawn and offset
        DB      LGX,LGY,QTOK,QEND ; -           K = G, where the route was entered
CLOSE8: CALL    ADVANC
; (fall into RTDONE)

; RTDONE - the route is over; the buffer keeps it for RECUT
; Clobbers B, HL
RTDONE: LXI     H,HELDN
        MVI     B,FITSM+1-HELDN
RTDON1: MVI     M,0             ; (RUNINI and DLINE come in here with their HL and B)
        INX     H
        DCR     B
        JNZ     RTDON1
        RET

; ENDRT - ends the open route: closed when its last item is its first, else open
; Clobbers all
ENDRT:  CALL    FITEND
        LDA     RITEMS
        ORA     A
        RZ
        DCR     A
        JZ      ERGEO           ; a single item
        CALL    NOFIL
        CALL    SAMEL
        JZ      CLOSE
        LDA     RLASTP
        ORA     A
        JZ      ERGEO           ; the end is no point
        CALL    PATC
        JMP     CLOSE8

; SFROM - statement: FROM point
SFROM:  CALL    EVPNT
        DB      CHKEND
        CALL    SCALED
        DB      CALC,QVEC,QEND  ; x y           kept while the route ends
        CALL    ENDRT
        DB      CALC,SHY,SHX,QEND ; -
        JMP     REPOS

; ROUTER - after an error: D when a route was open, which is forgotten   Clobbers all
ROUTER: LDA     RITEMS
        PUSH    PSW
        CALL    RTNEW
        POP     PSW
        ORA     A
        RZ
        JMP     STOP

; PASSP - the wire travels C to K; the contour goes on from P, the corner as drawn
; In:  as ADVANC, P   Out: as ADVANC, D = P   Clobbers all
PASSP:  CALL    ADVANC
        DB      CALC,LPX,SDX,LPY,SDY,QRET ; -

; WRAP - demands that the travel on the circle C, from A to K, differs by no more than half a turn from the travel
;        as drawn, from D to P: else the wire would leave the element out, or run round all of it
; In:  C, A, K, D, P; t3 negative when the wire travels more than half a turn   Out: ERR 06
; Clobbers all
; One of them must be less than half a turn, the other one more.  With a and b their cosines and sines,
; they differ by more than half a turn when the sine of b less a has the sign of b's own.
WRAP:   LDA     FITSM           ; (arcs of one curve touch each other: their corners stay)
        ORA     A
        RNZ
        DB      CALC,LDX,LDY,LPX,LPY,QTRAV ; s
        DB      LC2,QABS,QMU,QMUL,QADD ; s      none when 1 um backwards
        DB      QDUP,LT3,QSIG,QNEG,QJN ; s      both in one half
        DB      WRAP1-$
        DB      QDOT            ; s c
        DB      LAX,LAY,LKX,LKY,QTRAV,QDOT ; s c s c
        DB      SA0,SA1,SB0,SB1 ; -             a = the wire's travel, b = that as drawn
        DB      QCRS,LB1,QSIG,QNEG,QE6N+QRET ; -
WRAP1:  DB      QDRP+QRET       ; -

; Operations of the calculator that the route adds

; QTRAV: x1 y1 x2 y2 -> s: from the first direction to the second, as seen from the centre of C
XTRAV:  DB      LC1,QSUB,SB1,LC0,QSUB,SB0 ; x1 y1
        DB      LC1,QSUB,SA1,LC0,QSUB,SA0 ; -
        DB      QCRS,LC2,QSIG+QRET ; s
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
        JMP     OJMP1
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
        DB      QCA,QNORM,SB1,SB0 ; -
        DB      QCRS,QABS,QMU,QSUB+QRET ; |sine|-0.001

; QCHDA: x y -> dy dx: from a0 a1 to x y, times t0
XCHDA:  DB      LA1,QSUB,LT0,QMUL,QSWP ; dy x
        DB      LA0,QSUB,LT0,QMUL+QRET ; dy dx

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

; SBACK - statement: BACK
SBACK:  DB      CHKEND
        CALL    FITEND
        CALL    NEEDEL          ; no route, or but a point
SBACK1: CALL    CLOSE
        LXI     H,CLOSED
        INR     M
        JMP     HOME

; ADVANC - the wire travels C to the corner K
; In:  C, A, K, W; RELEMS = 0: C is closed, no travel means the whole circle
; Out: A = K, W; ERR 06 when K lies behind A on a line   Clobbers all
ADVANC: DB      CALC,LKX,LAX,QSUB,SB0 ; -
        DB      LKY,LAY,QSUB,SB1 ; -            b = chord
        DB      QCA,QJC         ; -
        DB      ADVAN2-$
        DB      QCRS            ; forward
        DB      QMU,QADD,QE6N   ; -
        DB      QEND            ; -
        JMP     MOVE
ADVAN2: DB      LB0,LB1,QFAR    ; negative: within 1 um
        DB      QJN             ; -
        DB      ADVAN3-$
        DB      LAX,LAY,LKX,LKY,QTRAV ; s       < 0: more than half a turn
        DB      QDUP,ST3,QEND   ; s
        CALL    WRAP
        JMP     ARC
ADVAN3: DB      Q1,ST3,QEND     ; -             no travel: the corner is the entry place
        CALL    WRAP
        LDA     RELEMS
        ORA     A
        RNZ
        DB      CALC,QM1,QEND   ; s             as ARC takes it
        JMP     ARC
