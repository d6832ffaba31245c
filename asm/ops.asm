; ops.asm - the operations of the calculator: their numbers, and their routines
; Offers: names for all
; Uses:   calc cut float geom grid parser value
; Room:   104 bytes
;
; Behind each number: what is on the float stack before and after, the top last; other effects.
; The numbers up to OPPOP pop one float; from OPBYTE on the routine is byte-code itself.
; The table lies within a page, where CALC counts in one byte.

;! (OPTAB-2)/100H == (OPEND-1)/100H -- CALC makes the low byte alone of a place in the table
;! OPEND-OPTAB == 2*QXING -- every number has its routine

QEND    EQU 00H         ; the program goes on in machine code
QADD    EQU 01H         ; x y -> x+y
QSUB    EQU 02H         ; x y -> x-y
QMUL    EQU 03H         ; x y -> x*y
QDIV    EQU 04H         ; x y -> x/y
QJN     EQU 05H         ; x ->
QJZ     EQU 06H         ; x ->
QDRP    EQU 07H         ; x ->
QSIG    EQU 08H         ; x y -> x, or -x when y is negative
QMAX    EQU 09H         ; x y -> the greater; neither may be negative (else but: 0 when both are 0)
QE6N    EQU 0AH         ; x ->    ERR 06 when negative
OPPOP   EQU 0AH         ; (the last that pops)
QJMP    EQU 0BH
QRET    EQU 0CH         ; ends the byte-code and returns from the routine, A not 0, Z clear
QDUP    EQU 0DH         ; x -> x x
QOVR    EQU 0EH         ; x y -> x y x
QSWP    EQU 0FH         ; x y -> y x
QSQ     EQU 10H         ; x -> x*x
QDBL    EQU 11H         ; x -> x+x
QNEG    EQU 12H         ; x -> -x
QFLR    EQU 13H         ; x -> greatest whole number not above
QSQRT   EQU 14H         ; x -> square root
QSIN    EQU 15H         ; x -> sine of x degrees
QCOS    EQU 16H
QTG     EQU 17H
QATG    EQU 18H         ; x -> arc tangent in degrees
QABS    EQU 19H         ; x -> |x|
QINT    EQU 1AH         ; x = a0 -> greatest whole number not above, nearly whole ones taken as whole
QXCH    EQU 1BH         ; ->      a and b exchanged
QCA     EQU 1CH         ; ->      a = C
QNA     EQU 1DH         ; ->      a = N
QJC     EQU 1EH         ; ->      jump when a is a circle
QONEL   EQU 1FH         ; ->      ERR 06 when the point b is not on the element a
QFAR    EQU 20H         ; x y -> negative when x*x+y*y is less than 1 um squared
OPBYTE  EQU 21H         ; (from here on: byte-code)
QCRS    EQU 21H         ; -> a0*b1-a1*b0
QDOT    EQU 22H         ; -> a0*b0+a1*b1
QDIF    EQU 23H         ; -> b0-a0 b1-a1
QVEC    EQU 24H         ; ->      a0 a1
QSS     EQU 25H         ; x y -> x*x+y*y
QHYP    EQU 26H         ; x y -> square root of x*x+y*y
QWAY    EQU 27H         ; x2 x1 y2 y1 -> w*w  b0 b1 = w: x2-x1 y2-y1
QALNG   EQU 28H         ; k ->    a0 a1 less k times b0 b1
QROTV   EQU 29H         ; ->      a0 a1 turned by b0 degrees; b0 b1 = b1 b2
QLEG    EQU 2AH         ; gap -> h  crossing of a line and a circle: distance from the foot
QUNIT   EQU 2BH         ; x y ->  a0 a1 = unit vector, t3 = length; ERR 06 when nearly 0
QCENT   EQU 2CH         ; x y ->  e  as QUNIT for two centres, x y apart; e = r1-r2; ERR 06 when within TL
QE6D    EQU 2DH         ; x y ->  ERR 06 when more than 1 um apart
QRND    EQU 2EH         ; mm -> whole um
QVK     EQU 2FH         ; ->      V = K in whole um, A = K
QTOK    EQU 30H         ; x y ->  K = b0 b1 = x y
QNORM   EQU 31H         ; ->      a0 a1 = right normal of a at the point b
QNORMS  EQU 32H         ; ->      a0 a1, b0 b1 = right normals of C and N at K; negative: they run the same way
QSENS   EQU 33H         ; R ->    negative when a is a circle that R would turn inside out
QXING   EQU 34H         ; ->      a0 a1 = crossing of C and N as offset

OPTAB:  DW      FADD,FSUB,FMUL,FDIV,OJN,OJZ,ODRP,XSIG,XMAX,XE6N
        DW      OJMP,ORET,ODUP,OOVR,OSWP,OSQ,ODBL,FNEG,FFLR
        DW      FSQR,FSIN,FCOS,FTG,FATG,FABS,FINT
        DW      XXCH,XCA,XNA,XJC,XONEL,XFAR
        DW      XCRS,XDOT,XDIF,XVEC,XSS,XHYP,XWAY
        DW      XALNG,XROTV,XLEG,XUNIT,XCENT,XE6D
        DW      XRND,XVK,XTOK,XNORM,XNORMS,XSENS,XXING
OPEND:                          ; (its end)
