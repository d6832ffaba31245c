; arc_iso.asm - arcs as ISO blocks (milling.md, section "Arcs")
; Offers: ARC
; Uses:   [post] calc consts float geom round start
; Room:   79 bytes

; ARC - the tool goes along the circle C to K
; In:  C, K, W; t3 negative when it is more than half a turn
; Out: W = V; ERR 10   Clobbers all
ARC:    DB      CALC,QVK        ; -
        DB      LC0,QRND,LWX,QSUB,QDUP,SA0 ; x  a = from the start to the centre
        DB      Q1000,QDIV,QRND,SBX ; -         (I: no more digits than any place)
        DB      LC1,QRND,LWY,QSUB,QDUP,SA1 ; y
        DB      Q1000,QDIV,QRND,SBY ; -
        DB      LVX,LWX,LVY,LWY,QWAY ; d^2      b = chord
        DB      QVEC,QHYP,QDBL,QSUB ; d^2-2r
        DB      LT3,QJN         ; d^2-2r
        DB      ARC2-$
        DB      QNEG,QJN        ; -
        DB      ARC1-$
ARCL:   DB      QEND            ;               flat, or no sweep, or an end in the centre: a line
        JMP     MOVE
ARC1:   DB      QCRS,LC2,QSIG,QJN ; -           the end lies ahead, as the circle turns
        DB      ARC3-$
        DB      QVEC,QSS,QDOT,QSUB,QJN ; -      far apart: no doubt
        DB      ARC3-$
        DB      QJMP
        DB      ARCL-$
ARC2:   DB      QDRP,QVEC,QSS,QDIF,QSS,QMUL,QJZ ; -
        DB      ARCL-$
ARC3:   DB      QEND
        LDA     MC2+1           ; bit 7: clockwise
        RLC
        SBB     A
        ADI     3
        STA     RGNUM
        MVI     C,4
        JMP     GXY
