; arc_nodrift.asm - arcs as 3B blocks, each from where the controller stands (docs/drift.md)
; Offers: ARC
; Uses:   [post] calc consts float geom round start
; Room:   263 bytes
;
; An arc is looked at, and J counted, as in arc_3b.asm, whose header has u, v and F.
;
; W is where the controller really stands, and the centre of an arc is moved, so that the
; arc from there passes V (docs/drift.md).

; ARC - the wire goes along the circle C to K, from where the controller stands
; In:  C, K, W; t3 negative when it is more than half a turn   Out: W = V
; Clobbers all
ARC:    DB      CALC,QVK        ; -
        DB      LC0,QRND,LC1,QRND,QSA ; -
        DB      LVX,LVY,QSB     ; -
        DB      QDIF,LC2,QSIG   ; u v           of the end; mirrored when clockwise
        DB      LWX,LWY,QSB     ; u v
        DB      QDIF,LC2,QSIG   ; u v u v       of the start
        DB      QSA,QSB         ; -             a = start, b = end
        DB      QDIF,ST1,ST0    ; -             t0 t1 = chord d
        DB      LT0,LT1,QSS,ST4 ; -             t4 = |d|^2
        DB      QDOT,QJN        ; -             ends far apart: no doubt
        DB      ARC0-$
        DB      LT3,QJN         ; -             nearly round: any shift is too much
        DB      ARC1-$
        DB      QVEC,QHYP,QDBL ; 2r
        DB      LT4,QSUB,QJN    ; -             short; |d|^2 <= 2r, within 1/4 um:
        DB      ARC0-$
ARCL:   DB      QEND            ;               a line
        JMP     MOVE
; the centre goes along the chord to where both ends are equally far from it
ARC0:   DB      LA0,LT0,QMUL,LA1,LT1,QMUL,QADD ; a*d
        DB      LT4,QDIV,QHALF,QADD,ST2 ; -     t2 = shift / d
        DB      LA0,LT2,LT0,QMUL,Q502,QADD,QFLR,QSUB,SA0 ; -
        DB      LA1,LT2,LT1,QMUL,Q502,QADD,QFLR,QSUB,SA1 ; -
        DB      LA0,LT0,QADD,SB0,LA1,LT1,QADD,SB1 ; -
ARC1:   DB      QEND
        CALL    ARCZ
        DB      CALC,LBX,LBY,QMAX,QJZ ; -       the start is the centre: no arc
        DB      ARCL-$
        DB      LT3,QJN         ; -             an arc of up to half a turn ...
        DB      ARC5-$
        DB      LA1,LB1,QSIG,QJN ; -            ... in one half plane needs no r
        DB      ARC5-$
        DB      LA0,LB0,QSUB,LB1,QSIG ; d       = F(end)-F(start)
        DB      QDUP,QNEG,QJN   ; d             (below 0 when (r,0) was passed)
        DB      ARC7-$
        DB      QDRP            ; -
ARC5:   DB      Q1,QEND
        CALL    AROOT
        DB      CALC,ST5        ; -             t5 = where the controller turns
ARC6:   DB      LA0,LT5,QADD,LA1,QSIG ; 2r-F(start)
        DB      LB0,LT5,QADD,LB1,QSIG,QSUB ; d  = F(end)-F(start)
        DB      QDUP,LT5,LT3,QSIG,QADD ; d d+r  long: d-r; below 0 when (r,0) was passed
        DB      LT5,QDBL,QSWP,QSIG,QSUB ; d-2r     then d+2r
        DB      LT5,QDBL,QADD   ; J
ARC7:   DB      QABS,QDUP,SBJ,QJZ ; -
        DB      ARCL2-$         ; counted as nothing: a line
; V = where the controller will stand: the step that ends the block goes from w+1 to w
        DB      LB0,LB1,QSIG,ST1 ; -            t1 = w
        DB      LT1,Q1,QADD,QEND ; w+1
        CALL    AROOT           ; |v|
        DB      CALC,QHALF,LT1,QSIG,QADD,QHALF,QSUB ; |v|    less 1 when w < 0
        DB      LB1,QSIG,LB1,QSUB ; dv          v less that of b
        DB      LT0,QJN         ; dv            back into the drawing's axes
        DB      ARC8-$
        DB      LC2,QSIG,LVY,QADD,SVY ; -
        DB      QJMP
        DB      ARC9-$
ARC8:   DB      LVX,QSWP,QSUB,SVX ; -
ARC9:   DB      QEND
        JMP     PUTBLK
ARCL2:  DB      QEND            ;               (ARCL is too far away)
        JMP     MOVE

; AROOT - w -> least whole number whose square reaches n-w^2, n = a0^2+a1^2 (byte-code)
; (the root, rounded, is k or one less; k^2-a1^2 and w^2-a0^2 as products are exact while they are below 2^32. They are
; so up to 65 mm, for a short arc of any radius, and, a0 and a1 exchanged, for one that ends about an axis further on)
; Clobbers T2, T4
AROOT:  DB      CALC,ST2        ; -             t2 = w
        DB      LT2,QSQ,QDBL,LA0,LA1,QSS,QSUB ; 2w^2-n
        DB      LA0,QSQ,LA1,QSQ,QSUB,QSIG,QJN ; - above 0: |w| is nearer to |a0| than to |a1|
        DB      AROOT2-$
AROOT0: DB      LT2,LA0,QADD,LT2,LA0,QSUB,QMUL ; p = w^2-a0^2
        DB      QDUP,LA1,QSQ,QSUB,QABS,QSQRT,Q502,QADD,QFLR,ST4 ; p
        DB      LT4,LA1,QSUB,LT4,LA1,QADD,QMUL,QADD ; k^2-(n-w^2)
        DB      QJN
        DB      AROOT1-$
        DB      LT4,QRET        ; k
AROOT1: DB      LT4,Q1,QADD+QRET ; k+1
AROOT2: DB      LA0,LA1,SA0,SA1,QEND
        LXI     D,AROOT0
        CALL    RUNBC
        DB      CALC,LA0,LA1,SA0,SA1,QRET
