; arc_3b.asm - arcs as 3B blocks, each from its own rounded start (tape-3b.md)
; Offers: ARC
; Uses:   [post] calc consts float geom round start
; Room:   101 bytes
;
; An arc is looked at from its rounded centre, mirrored when it runs clockwise, so that there
; is one sense to think about; for the count along Y it is turned by a quarter, so that the
; count always runs along u:
;
;       (u,v) going round counter-clockwise from (r,0): u falls from r to -r in the
;       upper half plane, rises again in the lower.  F = r-u there, 3r+u here, is the
;       travel counted since (r,0): F = 2r - (u+r) * sign of v.  J = F(end) - F(start),
;       and 4r more when (r,0) was passed.  That is so when the difference is below -r,
;       or below r when the arc is more than half a turn: nothing between comes up.
;       r cancels out, and its square root is saved, when both ends lie in one half
;       plane; a start on the axis does not matter: it is r or -r itself.

; ARC - the wire goes along the circle C to K, each block from its own rounded start
; In:  C, K, W; t3 negative when it is more than half a turn   Out: W = V
; Clobbers all
ARC:    DB      CALC,QVK        ; -
        DB      LC0,QRND,LC1,QRND,QSA ; -
        DB      LVX,LVY,QSB     ; -
        DB      QDIF,LC2,QSIG   ; u v           of the end; mirrored when clockwise
        DB      LWX,LWY,QSB     ; u v
        DB      QDIF,LC2,QSIG   ; u v u v       of the start
        DB      QSA,QSB         ; -             a = start, b = end
        DB      QHALF,QCRS,QSUB ; -
        DB      QJN
        DB      ARC1-$
        DB      LT3,QJN         ; -
        DB      ARC1-$
        DB      QDOT,QJN        ; -             far apart: no doubt
        DB      ARC1-$
ARCL:   DB      QEND            ;               short, and the sweep is not positive: a line
        JMP     MOVE
ARC1:   DB      QEND
        CALL    ARCZ
        DB      CALC,LT3,QJN    ; -             an arc of up to half a turn ...
        DB      ARC5-$
        DB      LA1,LB1,QSIG,QJN ; -            ... in one half plane needs no r
        DB      ARC5-$
        DB      LA0,LB0,QSUB,LB1,QSIG ; d       = F(end)-F(start)
        DB      QDUP,QNEG,QJN   ; d             (below 0 when (r,0) was passed)
        DB      ARC7-$
        DB      QDRP            ; -
ARC5:   DB      QVEC,QSS        ; n             t5 = r = root of n to the nearest: f = the root
        DB      QDUP,QSQRT,QFLR,QADD ; n+f      cut off; n+f reaches (f+1)^2 from n = f^2+f+1 on,
        DB      QSQRT,QFLR,ST5  ; -             where f+1 is nearer
        DB      LA0,LT5,QADD,LA1,QSIG ; 2r-F(start)
        DB      LB0,LT5,QADD,LB1,QSIG,QSUB ; d  = F(end)-F(start)
        DB      QDUP,LT5,LT3,QSIG,QADD ; d d+r  long: d-r; below 0 when (r,0) was passed
        DB      LT5,QDBL,QSWP,QSIG,QSUB ; d-2r     then d+2r
        DB      LT5,QDBL,QADD   ; J
ARC7:   DB      QABS,QDUP,SBJ,QJZ ; -
        DB      ARCL-$          ; counted as nothing: a line
        DB      QEND
        JMP     PUTBLK
