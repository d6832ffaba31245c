; corner.asm - where the wire goes from one element to the next: corners, fillets, the entry; which curves are the same
; Offers: JOINED CPYEL CPYPL FILLET TON PASSED OFFCHK CORND FIRST PATC SAMEF SAMEC SAMEL
; Uses:   [post] calc consts float geom round route start value
; Room:   481 bytes

; (FILLET comes here when it turns by nothing)
FILL9:  DB      QDOT,QE6N,QEND  ; -             straight on, or straight back
; (fall into JOINED)

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

; FILLET - as JOINED, with the arc that rounds the corner before N; no arc when C and N run on without a turn
; In:  C, N, FI; RTURN, RNAMED; P = the corner as drawn   Out: D = that corner   Clobbers all
; The arc turns as the corner does; its centre is where the parallels at its signed
; radius FI cross (SKG book, formula 9-7).
FILLET: DB      CALC,QPTOK,QNORMS,QJN ; -
        DB      FILL9-$
        DB      LCR,LNR,QE6D    ; -
        DB      LFI,QABS,QCRS,QSIG ; fi         as the corner turns
        DB      LFI,QOVR,QSUB,QE6N ; fi         a negative one is wanted clockwise
        DB      QNEG,QDUP,SO1,SO2 ; -
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
        DB      LPX,LPY,QVEC,QVEC ; px py x y x y
        DB      QSB,SPY,SPX     ; px py         a = b = P = centre: C touches the arc in its direction
        DB      LO1,QNEG,SA2,QEND ; px py
        MVI     A,KCIR
        CALL    PUTN
        CALL    PASSED          ; its touching point comes before the corner
        CALL    OFFCHK
        CALL    JOINED
        LXI     D,RKEPT
        CALL    TON
        CALL    JOINED
        DB      CALC,SDY,SDX,QRET ; -           the corner as drawn, without the arc

; TON - an element becomes the next one (CLOSE calls it too)
; In:  DE -> element   Clobbers A, BC, DE, HL
TON:    LXI     H,MNEXT
        JMP     CPYEL

; PASSED - on the way along the circle C from its entry A, does the point T = b come before K?
;          All as seen from the centre
; In:  C, A, K, b   Out: ERR 06 when not (never on a line: ADVANC looks after that)
; Clobbers all, K too
; It does when the chords to T and K turn as C does.  Places within 1 um, on the wire's path, are one;
; when K is the entry a fillet has no room (FILLET comes with RFILW set, CLOSE without).
PASSED: DB      CALC,QCA,QJC    ; -
        DB      PASS1-$
PASS2:  DB      QRET
PASS1:  DB      QNORM,QVEC      ; tx ty
        DB      LC2,LCR,QADD,ST0 ; tx ty                t0 = r of the wire's path
        DB      QCA,LKX,LKY,QTOK,QNORM,QVEC ; tx ty kx ky
        DB      QCA,LAX,LAY,QTOK,QNORM ; tx ty kx ky  a = of the entry
        DB      QCHDA,QSB       ; tx ty         b = chord to K
        DB      QCHDA,QSA       ; -             a = chord to T
        DB      QVEC,QFAR,QJN   ; -             T is the entry
        DB      PASS2-$
        DB      LB0,LB1,QFAR,QJN ; -            K is the entry
        DB      PASS3-$
        DB      QDIF,QFAR,QJN   ; -             T is K
        DB      PASS2-$
        DB      QCRS,LC2,QSIG,QE6N+QRET ; -
PASS3:  DB      QEND
        JMP     NOFIL

; OFFCHK - demands that the offset leaves a circle N its sense
; Out: ERR 07   Clobbers all
OFFCHK: DB      CALC,QNA,LNR,QSENS,QJN ; -
        DB      OFFCH1-$
        DB      QRET
OFFCH1: DB      QEND
        DB      ERROR,EOFFS

; CORND - the corner between C and N as drawn, which no point names
; In:  C, N, RTURN   Out: P; TL, for CORNER too   Clobbers all
CORND:  DB      CALC,QEPS,STL   ; -             a corner is no `*`: curves that do cross do so
        DB      Q0,SO1,Q0,SO2,QXING ; -
        DB      QVEC,SPY,SPX,QRET ; -

; CORNER - the corner between C and N as offset
; In:  C, N, RTURN, RNAMED; P, or TL from CORND   Out: K, O1, O2   Clobbers all
CORNER: DB      CALC,LCR,SO1,LNR,SO2,QEND ; -
; CORNO - the corner between C and N offset by O1 and O2
; In:  C, N, O1, O2, RTURN, RNAMED; P, or TL   Out: K   Clobbers all
; A named one is P itself when there is no offset; else of the crossings the one nearest to P,
; where both run the same way through P, P moved R to the right.  Lines between points (bit 7 of
; their kind) are taken to pass P: gamma is rounded, and at a flat corner that would be magnified.
CORNO:  LDA     RNAMED
        ORA     A
        JZ      CROSS
        DB      CALC,QPTOK      ; -             K = P = b
        DB      Q0,STL,QEND     ; -             crossings, however flat
        LDA     MO1
        LXI     H,MO1+5
        ORA     M
        RZ                      ; no offset
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
        XRA     A
        STA     RTURN
        CALL    CROSS           ; (QRET leaves A not 0)
        STA     RTURN
        DB      CALC,QXING      ; -
        DB      LPX,LA0,LPY,LA1,QWAY ; d2^2
        DB      LPX,LKX,LPY,LKY,QWAY ; d2^2 d1^2
        DB      QSUB,QJN        ; -
        DB      ATOK-$
        DB      QRET
; a corner that no point names: the crossing
CROSS:  DB      CALC,QXING      ; -
ATOK:   DB      QVEC,QTOK+QRET  ; -
CORN2:  DB      CALC            ; as seen from P both pass at their offsets alone
        DB      LO1,SA2,LO2,SB2,QSXS ; -
        DB      LKX,LKY,QSB,Q1,QJMP ; 1
        DB      NAMED3-$
CORN1:  DB      CALC            ; between arcs of a curve: both run the same way, square to the radius
        DB      QCA,QDIF,QSA    ; -            a = from the centre to P
        DB      LCR,LNR,QE6D    ; -
        DB      LCR,LC2,QDIV,QJMP ; R/r
        DB      NAMED3-$
NAMED1: DB      QDOT,QE6N       ; -             there and back
        DB      QPTOK           ; -
        DB      LCR,LNR,QE6D    ; -             no crossing any more
NAMED2: DB      LCR             ; R
NAMED3: DB      QXCH,QALNG,QJMP ; -             b moved along a
        DB      ATOK-$

; FIRST - N is the first element: the wire goes to it
; In:  N, P or H   Out: C = F = N, K; it goes on to ENTER; ERR 07   Clobbers all
FIRST:  CALL    OFFCHK
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
        DB      LC0,LC1,QSB,QJMP ; r            b = centre
        DB      NAMED3-$
PLACE2: DB      QABS,LC0,QADD,LC1,QTOK+QRET ; - the +X side

; FIRST1 - the wire goes to the entry K; the contour as drawn begins in the same direction from a centre
; In:  K   Out: G, D   Clobbers all
FIRST1: CALL    ENTER           ; (tape.asm)
        DB      CALC,LGX,LGY,QSB,QCA,QNORM ; -      b = G, a = its right normal
        DB      LCR,QNEG,QXCH,QALNG,QVEC,SDY,SDX ; - back by R
SAME9:  DB      QRET            ;               (for SAME too: leaves Z clear)

; PATC - place of the point P on C, as offset: P moved R to the right
; Out: K   Clobbers all
PATC:   DB      CALC,QPTOK        ; -             b = K = P
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
        CALL    GETREC          ; a = the element
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
        DB      LT1,LT2,QSB,QDOT ; place along N's normal
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

; SAMEL - is the last item, as written, the first one?
; Out: Z set when it is   Clobbers all
SAMEL:  LHLD    RLASTP          ; and RFSTP
        MOV     A,L
        CMP     H
        RNZ
        ORA     A
        JZ      SAMEF
        DB      CALC,LPX,LQX,LPY,LQY,QWAY ; distance^2
        DB      QSQRT           ; distance
        DB      QJMP
        DB      SAME1-$
