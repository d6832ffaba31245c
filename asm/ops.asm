; ops.asm - the operations of the calculator: their numbers, and their routines
; Offers: names for all
; Uses:   calc cut fit float geom parser round route value
; Room:   128 bytes
;
; Behind each number: what is on the float stack before and after, the top last; other effects.
; The numbers from OPPOP on pop one float; from OPBYTE on the routine is byte-code itself.
; The table lies within a page, where CALC counts in one byte.
;
; Added to QRET an operation is carried out, then the byte-code is left: QADD+QRET is QADD,QRET in
; one byte. Up to QTOK, but for jumps and QEND, that is possible.

;! OPTAB/100H == (OPEND-1)/100H -- CALC makes the low byte alone of a place in the table
;! OPEND-OPTAB == 2*(QDIF+1) -- every number has its routine
;! QTOK+QRET == 0FFH -- the codes behind the constants are all used
;! QJN+QRET == CALC -- a jump does not stand in front of QRET: the restart is no byte-code, the debugger knows it by that
;! (OPTAB & 0FFH) > 0 -- QRET leaves A not 0

QEND    EQU 00H         ; the program goes on in machine code
QJMP    EQU 01H
QDUP    EQU 02H         ; x -> x x
QOVR    EQU 03H         ; x y -> x y x
QSWP    EQU 04H         ; x y -> y x
QSQ     EQU 05H         ; x -> x*x
QDBL    EQU 06H         ; x -> 2*x
QNEG    EQU 07H         ; x -> -x
QFLR    EQU 08H         ; x -> greatest whole number not above
QSQRT   EQU 09H         ; x -> square root
QSIN    EQU 0AH         ; x -> sine of x degrees
QCOS    EQU 0BH
QTG     EQU 0CH
QATG    EQU 0DH         ; x -> arc tangent in degrees
QABS    EQU 0EH         ; x -> |x|
QINT    EQU 0FH         ; x = a0 -> greatest whole number not above, nearly whole ones taken as whole
QXCH    EQU 10H         ; ->      a and b exchanged
QCA     EQU 11H         ; ->      a = C
QNA     EQU 12H         ; ->      a = N
QJC     EQU 13H         ; ->      jump when a is a circle
QONEL   EQU 14H         ; ->      ERR 06 when the point b is not on the element a
QFAR    EQU 15H         ; x y -> negative when x*x+y*y is less than 1 um squared
QFITS   EQU 16H         ; x -> x   ERR 10 when it has more than eight digits
OPPOP   EQU 17H         ; (from here on: one is popped)
QADD    EQU 17H         ; x y -> x+y
QSUB    EQU 18H         ; x y -> x-y
QMUL    EQU 19H         ; x y -> x*y
QJN     EQU 1AH         ; x ->
QDIV    EQU 1BH         ; x y -> x/y
QJZ     EQU 1CH         ; x ->
QDRP    EQU 1DH         ; x ->
QSIG    EQU 1EH         ; x y -> x, or -x when y is negative
QE6N    EQU 1FH         ; x ->    ERR 06 when negative
OPBYTE  EQU 20H         ; (from here on: byte-code)
QSA     EQU 20H         ; x y ->  a0 a1 = x y
QSB     EQU 21H         ; x y ->  b0 b1 = x y
QTOA    EQU 22H         ; x ->    a0 = x
QSS     EQU 23H         ; x y -> x*x+y*y
QHYP    EQU 24H         ; x y -> square root of x*x+y*y
QWAY    EQU 25H         ; x2 x1 y2 y1 -> w*w  b0 b1 = w: x2-x1 y2-y1
QALNG   EQU 26H         ; k ->    a0 a1 and k times b0 b1
QROTV   EQU 27H         ; ->      a0 a1 turned by b0 degrees; b0 b1 = b1 b2
QUNIT   EQU 28H         ; x y ->  a0 a1 = unit vector, t3 = length; ERR 06 when nearly 0
QE6D    EQU 29H         ; x y ->  ERR 06 when more than 1 um apart
QTOK    EQU 2AH         ; x y ->  K = b0 b1 = x y
QMAX    EQU 2BH         ; x y -> the greater
QSXS    EQU 2CH         ; ->      a0 a1 = crossing of the lines a and b; ERR 06
QCHRD   EQU 2DH         ; -> v*v  chord of nodes 1 and 2: b = v, a = t+u
QBIAR   EQU 2EH         ; v*v ->  behind QCHRD: MX MY = joint of the biarc; ERR 06
QMIRR   EQU 2FH         ; b*b -> y x  a mirrored about b; behind QCHRD: the tangent that is not known
QLEG    EQU 30H         ; gap -> h  crossing of a line and a circle: distance from the foot
QCENT   EQU 31H         ; x y ->  e  as QUNIT for two centres, x y apart; e = r1-r2; ERR 06 when within TL
QRND    EQU 32H         ; mm -> whole um
QVK     EQU 33H         ; ->      V = K in whole um, A = K
QNORM   EQU 34H         ; ->      a0 a1 = right normal of a at the point b
QNORMS  EQU 35H         ; ->      a0 a1, b0 b1 = right normals of C and N at K; negative: they run the same way
QSENS   EQU 36H         ; R ->    negative when a is a circle that R would turn inside out
QXING   EQU 37H         ; ->      a0 a1 = crossing of C and N as offset
QCHDA   EQU 38H         ; x y -> dx dy  from a0 a1 to x y, times t0
QVEC    EQU 39H         ; ->      a0 a1
QPTOK   EQU 3AH         ; ->      K = b0 b1 = P
QSCL    EQU 3BH         ; x -> x in the scale of the tape
QCRS    EQU 3CH         ; -> a0*b1-a1*b0
QDOT    EQU 3DH         ; -> a0*b0+a1*b1
QSEEN   EQU 3EH         ; x1 y1 x2 y2 ->  a, b = these places as seen from the centre of C
QDIF    EQU 3FH         ; -> b0-a0 b1-a1
QRET    EQU 0D5H        ; ends the byte-code and returns from the routine, A not 0, Z clear, CY set

OPTAB:  DW      ODRP            ; (QRET alone: nothing, then back)
        DW      OJMP,ODUP,OOVR,OSWP,OSQ,ODBL,FNEG,FFLR
        DW      FSQR,FSIN,FCOS,FTG,FATG,FABS,FINT
        DW      XXCH,XCA,XNA,XJC,XONEL,XFAR,XFITS
        DW      FADD,FSUB,FMUL,OJN,FDIV,OJZ,ODRP,XSIG,XE6N
        DW      XSA,XSB,XTOA,XSS,XHYP,XWAY
        DW      XALNG,XROTV,XUNIT,XE6D,XTOK
        DW      XMAX,GSXS,XCHRD,XBIAR,XMIRR,XLEG,XCENT
        DW      XRND,XVK,XNORM,XNORMS,XSENS,XXING,XCHDA,XVEC
        DW      XPTOK,XSCL,XCRS,XDOT,XSEEN,XDIF
OPEND:                          ; (its end)
