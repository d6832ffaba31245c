; round.asm - where the wire goes, in whole micrometres (tape-3b.md, section "Rounding")
; Offers: XRND XFITS XVK XPTOK XTOK
; Uses:   calc consts float start
; Room:   47 bytes

; QRND: mm to whole um: halves away from zero, 2 nm below a half counts as a half
XRND:   DB      Q1000,QMUL         ; um
        DB      QDUP,QABS,Q502,QADD     ; um |um|+0.502
        DB      QFLR,QFITS              ; um |whole|
        DB      QSWP,QSIG+QRET          ; whole

; QFITS: demands that a number, not negative and whole, has no more than eight digits: ERR 10
XFITS:  MOV     A,M
        CPI     9BH             ; below 2^26 it has
        RC
        DB      CALC,QDUP,Q10,QSQ,QSQ,QSQ,QSUB ; x x-1E8
        DB      QJN             ; x
        DB      XFITS1-$
        DB      QEND            ; x
        DB      ERROR,ETAPE
XFITS1: DB      QRET            ; x

; QVK: V = K in whole um; A = K, since the wire goes there
XVK:    DB      LKX,QDUP,SAX,QRND,SVX   ; -
        DB      LKY,QDUP,SAY,QRND,SVY,QRET ; -
; QPTOK: K = b = P.  QTOK: K = b = a point
XPTOK:  DB      LPX,LPY         ; px py
XTOK:   DB      QDUP,SKY,SB1,QDUP,SKX,SB0,QRET ; -
