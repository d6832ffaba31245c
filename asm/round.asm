; round.asm - where the wire goes, in whole micrometres (tape-3b.md, section "Rounding")
; Offers: XRND XVK XPTOK XTOK
; Uses:   calc consts float start
; Room:   37 bytes

; QRND: mm to whole um: halves away from zero, 2 nm below a half counts as a half
XRND:   DB      Q1000,QMUL         ; um
        DB      QDUP,QABS,Q502,QADD     ; um |um|+0.502
        DB      QFLR,Q8DIG,QOVR,QSUB    ; um |whole| room
        DB      QJN
        DB      XRND1-$
        DB      QSWP,QSIG+QRET          ; whole
XRND1:  DB      QEND            ; um |whole|
        DB      ERROR,ETAPE
; QVK: V = K in whole um; A = K, since the wire goes there
XVK:    DB      LKX,QDUP,SAX,QRND,SVX   ; -
        DB      LKY,QDUP,SAY,QRND,SVY,QRET ; -
; QPTOK: K = b = P.  QTOK: K = b = a point
XPTOK:  DB      LPX,LPY         ; px py
XTOK:   DB      QDUP,SKY,SB1,QDUP,SKX,SB0,QRET ; -
