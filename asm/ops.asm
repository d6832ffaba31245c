; ops.asm - operations that geometry, route and tape add to the calculator
; Offers: the codes QDOT ... QVK; the rest of OPTAB
; Uses:   calc (this file must follow it), geom, cut, tape
; Room:   2 bytes an operation

QDOT    EQU QOWN        ; -> a0*b0+a1*b1
QCRS    EQU QOWN+1      ; -> a0*b1-a1*b0
QDIF    EQU QOWN+2      ; -> b0-a0 b1-a1
QHYP    EQU QOWN+3      ; x y -> square root of x*x+y*y
QCEN    EQU QOWN+4      ; -> a0*b1+a1*b2
QREFL   EQU QOWN+5      ; k ->    a0 a1 less k times b0 b1
QROTV   EQU QOWN+6      ; ->      a0 a1 turned by b0 degrees
QTCH    EQU QOWN+7      ; gap ->  negative: the curves cross
QSGN    EQU QOWN+8      ; x -> 1 or -1
QMAX    EQU QOWN+9      ; x y -> the greater
QE6N    EQU QOWN+10     ; x ->    ERR 06 when negative
QE6D    EQU QOWN+11     ; x ->    ERR 06 when more than 1 um from 0
QE6Z    EQU QOWN+12     ; x -> x  ERR 06 when nearly 0
QE5Z    EQU QOWN+13     ; x -> x  ERR 05 when nearly 0
QCA     EQU QOWN+14     ; ->      a = C
QNA     EQU QOWN+15     ; ->      a = N
QRND    EQU QOWN+16     ; mm -> whole um
QVK     EQU QOWN+17     ; ->      V = K in whole um
QJC     EQU QOWN+18     ; ->      jump when a is a circle
QONEL   EQU QOWN+19     ; ->      ERR 06 when the point b is not on the element a
QNORM   EQU QOWN+20     ; ->      a0 a1 = right normal of a at the point b
QFAR    EQU QOWN+21     ; x y -> negative when x*x+y*y is less than 1 um squared
QROOT   EQU QOWN+22     ; w -> least whole root of a0^2+a1^2-w^2 (option NODRIFT)

        DW      XDOT,XCRS,XDIF,XHYP,XCEN,XREFL,XROTV,XTCH
        DW      XSGN,XMAX,XE6N,XE6D,XE6Z,XE5Z
        DW      XCA,XNA,XRND,XVK,XJC,XONEL,XNORM,XFAR
        IF      NODRIFT
        DW      XROOT
        ENDIF
