; ops.asm - operations that geometry, route and tape add to the calculator
; Offers: nothing
; Uses:   calc cut geom parser tape value
; Room:   54 bytes

; The entry QOWN itself is INT, which belongs behind FFLR there (OPFN, parser.asm); byte-code
; would have to see that x is a0
QCRS    EQU QOWN+1      ; -> a0*b1-a1*b0
QDIF    EQU QOWN+2      ; -> b0-a0 b1-a1
QHYP    EQU QOWN+3      ; x y -> square root of x*x+y*y
QDOT    EQU QOWN+4      ; -> a0*b0+a1*b1
QALNG   EQU QOWN+5      ; k ->    a0 a1 less k times b0 b1
QROTV   EQU QOWN+6      ; ->      a0 a1 turned by b0 degrees; b0 b1 = b1 b2
QLEG    EQU QOWN+7      ; gap -> h  crossing of a line and a circle: distance from the foot
QE6D    EQU QOWN+8      ; x y ->  ERR 06 when more than 1 um apart
QUNIT   EQU QOWN+9      ; x y ->  a0 a1 = unit vector, t3 = length; ERR 06 when nearly 0
QXCH    EQU QOWN+10     ; ->      a and b exchanged
QCA     EQU QOWN+11     ; ->      a = C
QNA     EQU QOWN+12     ; ->      a = N
QRND    EQU QOWN+13     ; mm -> whole um
QVK     EQU QOWN+14     ; ->      V = K in whole um, A = K
QJC     EQU QOWN+15     ; ->      jump when a is a circle
QONEL   EQU QOWN+16     ; ->      ERR 06 when the point b is not on the element a
QNORM   EQU QOWN+17     ; ->      a0 a1 = right normal of a at the point b
QFAR    EQU QOWN+18     ; x y -> negative when x*x+y*y is less than 1 um squared
QSENS   EQU QOWN+19     ; R ->    negative when a is a circle that R would turn inside out
QNORMS  EQU QOWN+20     ; ->      a0 a1, b0 b1 = right normals of C and N at K; negative: they run the same way
QXING   EQU QOWN+21     ; ->      a0 a1 = crossing of C and N as offset
QSS     EQU QOWN+22     ; x y -> x*x+y*y
QCENT   EQU QOWN+23     ; x y ->  e  as QUNIT for two centres, x y apart; e = r1-r2; ERR 06 when within TL
QTOK    EQU QOWN+24     ; x y ->  K = b0 b1 = x y
QWAY    EQU QOWN+25     ; x2 x1 y2 y1 -> w*w  b0 b1 = w: x2-x1 y2-y1
QVEC    EQU QOWN+26     ; ->      a0 a1

        DW      FINT,XCRS,XDIF,XHYP,XDOT,XALNG,XROTV,XLEG
        DW      XE6D,XUNIT,XXCH
        DW      XCA,XNA,XRND,XVK,XJC,XONEL,XNORM,XFAR,XSENS
        DW      XNORMS,XXING,XSS,XCENT,XTOK,XWAY,XVEC
