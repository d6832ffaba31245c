; geom.asm - the operations of language.md, section 2.1, as calculator code
; Offers: BINOPK BINOP BINKND RSTAR XUNIT XSA XTOA GSXS BELT XDOT XCRS XVEC XDIF XCENT XWAY XSS XHYP
;         XFAR XALNG XROTV XSB XLEG XE6D
; Uses:   calc consts float start value
; Room:   511 bytes
;
; The left operand stands in a0 a1 a2, the right one in b0 b1 b2, unused ones zero:
; a point is a circle of radius 0, a number a point on the X axis, a rotation about O one
; about (0,0).  The result goes to a0 a1 a2.  Byte-code lines carry the float stack
; behind them, top last.

; BINOPK - carries out an operator
; In:  VKIND = kind of a, A = kind of b, C = rank   Out: as BINOP   Clobbers all
BINOPK: LXI     H,VKIND
        MOV     B,M
        MOV     M,A
; (fall into BINOP)

; BINOP - carries out an operator
; In:  B = kind of a, VKIND = kind of b, C = rank of the operator (parser.asm)
; Out: a0 a1 a2, VKIND; ERR 04 when the kinds do not combine   Clobbers all
BINOP:  MOV     A,C
        DCR     A
        CNZ     CHKRET
        CALL    CHECK
        MVI     A,KPNT          ; in check mode what a comma makes is taken for a point (ITCHK, cut.asm)
        JNZ     SETK
        MOV     A,C
        ADD     A
        ADD     A
        ADD     C
        ADD     B
        MOV     C,A
        ADD     A
        ADD     A
        ADD     C
        LXI     H,VKIND
        ADD     M
        MOV     C,A             ; C = key: 25*rank + 5*left + right; B = kind of the result
        LXI     H,GEOTAB
        LXI     D,GADD
BIN1:   MOV     A,M
        INX     H
        CMP     C
        JZ      BIN3
        CPI     KEY1
        JC      BIN2
        SUI     KINDS
        JC      BIN1            ; another key
        MOV     B,A
        CPI     KTURN+1
        JC      BIN1
        DB      ERROR,EKIND     ; the end
BIN2:   ADD     E               ; to the next byte-code
        MOV     E,A
        JNC     BIN1
        INR     D
        JMP     BIN1
BIN3:   PUSH    B
        CALL    RUNBC
        POP     B
; BINKND - the value is of kind B (OPNAM ends here, too)
; In:  B = kind   Out: VKIND, the floats that it has not are 0   Clobbers A, B, HL
BINKND: MOV     A,B
        JMP     SETK

; GEOTAB - which byte-code serves which operands.  It goes along the byte-codes, as they
; stand in memory:
;
;       below KEY1        so many bytes further on, to another byte-code
;       KEY1 to KINDS-1   key of an operator and two kinds that the byte-code serves
;       from KINDS up     kind of the results from here on, + KINDS; before the first one
;                         they are of the left operand's kind.  Past KTURN: the end
;
; Ranks: 1 comma, 2 #, 3 :, 4 +, 5 -, 6 *, 7 /
KEY1    EQU 25          ; the least key
KINDS   EQU 200         ; above the greatest
ONN     EQU KNUM*5+KNUM
ONP     EQU KNUM*5+KPNT
OPN     EQU KPNT*5+KNUM
OPP     EQU KPNT*5+KPNT
OPC     EQU KPNT*5+KCIR
OPS     EQU KPNT*5+KLIN
OPT     EQU KPNT*5+KTURN
OCN     EQU KCIR*5+KNUM
OCP     EQU KCIR*5+KPNT
OCC     EQU KCIR*5+KCIR
OCS     EQU KCIR*5+KLIN
OCT     EQU KCIR*5+KTURN
OSN     EQU KLIN*5+KNUM
OSP     EQU KLIN*5+KPNT
OSC     EQU KLIN*5+KCIR
OSS     EQU KLIN*5+KLIN
OST     EQU KLIN*5+KTURN
RCOM    EQU 25
RTRN    EQU 50
RCOL    EQU 75
RPLU    EQU 100
RMIN    EQU 125
RMUL    EQU 150
RDIV    EQU 175
RSTAR   EQU RMUL/25

;! GCXC-GSXC < KEY1 -- a longer way is two distances, as that to GPNT
GEOTAB: DB      RPLU+ONN,RPLU+OPP
        DB      GSUB-GADD,RMIN+ONN,RMIN+OPP
        DB      GFOOT-GSUB,RTRN+OPS
        DB      GMIRR-GFOOT,RDIV+OPS,RDIV+OCS
        DB      GMIRS-GMIRR,RDIV+OSS
        DB      GDIV-GMIRS,RDIV+ONN,RDIV+OPN
        DB      GROTP-GDIV,RTRN+OPN,RTRN+OCN,RTRN+OPT,RTRN+OCT
        DB      GMULT-GROTP,RMUL+ONN,RMUL+OPN
        DB      KINDS+KPNT
        DB      GNMUL-GMULT,RMUL+ONP
        DB      GPOLAR-GNMUL,RTRN+ONN
        DB      GSXS-GPOLAR,RMUL+OSS
        DB      GCXS-GSXS,RMUL+OCS
        DB      GSXC-GCXS,RMUL+OSC
        DB      GCXC-GSXC,RMUL+OCC
        DB      KEY1-1,GPNT-GCXC-KEY1+1,RCOM+ONN
        DB      KINDS+KTURN,RCOL+ONP
        DB      KINDS+KNUM
        DB      GSPDIS-GPNT,RCOM+OSP
        DB      GPSDIS-GSPDIS,RCOM+OPS,RMUL+OPP
        DB      GDIST-GPSDIS,RCOM+OPP
        DB      GANGLE-GDIST,RCOM+OSS
        DB      KINDS+KCIR
        DB      GTHRU-GANGLE,RDIV+OPP
        DB      GCIR-GTHRU,RCOL+OPN,RCOL+OCN
        DB      KINDS+KLIN
        DB      GBISEC-GCIR,RTRN+OPP
        DB      GBELT-GBISEC,RCOL+OPP,RCOL+OCC,RCOL+OCP,RCOL+OPC
        DB      GPARC-GBELT,RCOL+OSP,RCOL+OSC
        DB      GROTS-GPARC,RTRN+OSN,RTRN+OST
        DB      GPAR-GROTS,RCOL+OSN
        DB      KINDS+KTURN+1

; P+P, D+D: a1 and b1 of a number are 0; P-P, D-D
GADD:   DB      Q1,QALNG+QRET           ; -
GSUB:   DB      QM1,QALNG+QRET          ; -
; P#S: foot; P/S, C/S: mirror image; S/S: mirrored and reversed
GFOOT:  DB      LB2,QDOT,QSUB           ; e
        DB      QALNG+QRET              ; -
GMIRR:  DB      LB2,QDOT,QSUB           ; e
        DB      QDBL                    ; 2e
        DB      QALNG+QRET              ; -
GMIRS:  DB      QDOT,QDBL,QNEG          ; -2c           c = n1*n2
        DB      QDUP,LB2,QMUL,LA2       ; -2c -2c*g gamma
        DB      QADD,SA2                ; -2c
        DB      QALNG+QRET              ; -
; D/D, P/D
GDIV:   DB      QVEC,LB0,ST3            ; x y
        DB      QJMP
        DB      XUNIT2-$

; QUNIT: a0 a1 = unit vector along a vector, t3 = its length; ERR 06 when that is nearly 0
XUNIT:  DB      QOVR,QOVR,QHYP     ; x y d
; (for GSXS too)
XUNIT1: DB      QDUP,ST3,QABS           ; x y |d|
        DB      QNEAR,QSUB,QE6N         ; x y
; (for GDIV too)
XUNIT2: DB      LT3,QDIV,SA1            ; x
        DB      LT3,QDIV,QTOA+QRET      ; -

; P#A, C#A, P#(A:P), C#(A:P)
GROTP:  DB      LB1,LA0,QSUB            ; dx
        DB      LB2,LA1,QSUB,QSA        ; -             to the centre of rotation
        DB      QROTV                   ; -
        DB      QDIF                    ; dx dy         back from there
; QSA: a0 a1 = a vector.  QTOA: a0 = a number
XSA:    DB      SA1                     ; x
XTOA:   DB      SA0,QRET                ; -
; P*D, D*D; D*P: 0 - (-D)*P
GMULT:  DB      QXCH                    ; -
GNMUL:  DB      LA0,Q0,SA0              ; D
        DB      QALNG+QRET              ; -
; D#A: polar point, (D,0) turned
GPOLAR: DB      QROTV+QRET              ; -

; S*S: crossing by Cramer's rule; ERR 06 when they are parallel
GSXS:   DB      LA2,LB1,QMUL            ;
        DB      LA1,LB2,QMUL,QSUB       ; x*det
        DB      LA0,LB2,QMUL            ; x*det
        DB      LA2,LB0,QMUL,QSUB       ; x*det y*det
        DB      QCRS,QJMP               ; x*det y*det det
        DB      XUNIT1-$

; C*S = S*-C
GCXS:   DB      LA2,QNEG,SA2,QXCH       ; -
; S*C: foot of the centre, then along the line; to the left of S and C turning
; counter-clockwise that is forward
GSXC:   DB      LA2,QDOT,QSUB           ; e             centre left of S
        DB      QDUP,ST2,QABS           ; |e|           t2 = e
        DB      LB2,QABS,QSUB           ; gap
; (and the end of GCXC) Crossing of a line, given by its normal a0 a1, with the circle b;
; t2 is how far the centre lies to its left; on the stack: how far they miss; when they touch,
; the place is on that circle
GSXC1:  DB      LB2,QABS,ST3,QLEG       ; h
        DB      LB2,QSIG,QXCH           ; +-h
        DB      LT2,QALNG               ; +-h           the foot
        DB      LB1,QNEG,LB0,QSB        ; +-h           b = forwards
        DB      QALNG+QRET              ; -
; C1*C2: the crossing of C1 with the line through both crossings, whose right
; normal is the unit vector a from centre to centre, at c = (d^2+r1^2-r2^2)/2d
; from the first centre, which goes to b.
GCXC:   DB      QDIF,QXCH,QCENT         ; r2-r1         t3 = d
        DB      LA2,LB2,QADD,QNEG,QMUL  ; r1^2-r2^2
        DB      LT3,QDIV,LT3,QADD       ; 2c
        DB      QHALF,QMUL,ST2          ; -             t2 = c
        DB      LA2,QABS,LB2,QABS,QMAX  ; m             the greater one's radius
        DB      LT3,QOVR,QSUB,QABS,QADD ; m+|d-m|
        DB      LA2,QABS,QSUB           ;
        DB      LB2,QABS,QSUB           ; gap           = |d-m| less the other radius
        DB      LB2,LA2,QSIG,SB2        ; gap           the crossing's sign
        DB      QJMP
        DB      GSXC1-$

; A:P: a rotation; x,y: the point (a2 goes)
GPNT:   DB      LB1,SA2,LB0,SA1,QRET    ; -

; S,P and P,S: how far P lies to the right of S; P*P (b2 is 0)
GSPDIS: DB      QXCH                    ; -
GPSDIS: DB      QDOT,LB2,QSUB,QTOA+QRET ; -
; P,P: distance
GDIST:  DB      QDIF,QHYP,QTOA+QRET     ; -
; S,S: angle from the first direction to the second, with d = cosine, s = sine:
; 2*atg(s/(d+-1)), + for d from 0 up, is it or 180 off
GANGLE: DB      QCRS,QDOT               ; s d
        DB      Q1,QDOT,QSIG,QADD       ; s d+-1
        DB      QDIV,QATG,QDBL          ; angle
        DB      Q90,Q90,QDOT,QSIG,QSUB  ; angle 90-+90
        DB      QCRS,QSIG               ; angle 0 or +-180
        DB      QADD,QTOA+QRET          ; -

; P/P: a circle through a point; P:D, C:D
GTHRU:  DB      QDIF,QHYP,QJMP          ; r
        DB      GCIR1-$
GCIR:   DB      LA2,LB0,QADD            ; r
GCIR1:  DB      QDUP,SA2,QABS           ; |r|
        DB      QNEAR,QSUB              ; |r|-1E-7
        DB      QSQRT,QDRP+QRET         ; -             (the root refuses what is negative)

; P#P: perpendicular bisector, the first point on its left
GBISEC: DB      QDIF                    ; dx dy
        DB      Q1,QALNG,QXCH           ; dx dy         b = a+b
        DB      QUNIT                   ; -
        DB      QDOT,QHALF,QMUL,SA2     ; -
        DB      QRET
; The belt line: alpha*xi + beta*yi + ri = gamma for both circles.  With d from
; centre to centre, e = r1-r2 and h = sqrt(d^2-e^2): the unit vector along d, turned
; to the right by the angle whose cosine is e/d and whose sine h/d.
BELT:   DB      CALC            ; (for ITPNT: as a routine)
GBELT:  DB      QVEC                    ; x y
        DB      QDIF,QCENT              ; x y e         t3 = d
        DB      QDUP,ST2,QABS           ; x y |e|       t2 = e
        DB      LT3,QSUB,QLEG           ; x y h
        DB      QNEG,LT3,QDIV           ; x y h/d
        DB      LT2,LT3,QDIV,QSB        ; x y
        DB      QCRS,QDOT,QSA,QSB       ; -
        DB      QDOT,LA2,QJMP           ; g r
        DB      GPAR1-$
; S:P, S:C: the parallel that leaves C along its direction
GPARC:  DB      QDOT,LB2,QJMP           ; n*c r
        DB      GPAR1-$
; S#A, S#(A:P): gamma is kept as seen from the centre of the rotation
GROTS:  DB      LA2                     ; gamma
        DB      LA0,LB1,QMUL            ; gamma alpha*x
        DB      LA1,LB2,QMUL,QADD       ; gamma n*c
        DB      QSUB,QROTV              ; gamma'
        DB      QDOT,QJMP               ; gamma' n*c
        DB      GPAR1-$
; S:D: the parallel to the right
GPAR:   DB      LA2,LB0                 ; gamma d
GPAR1:  DB      QADD,SA2,QRET           ; -

; Operations of the calculator that geometry adds: byte-code but for QFAR (OPTAB, ops.asm)

; QDOT a0*b0+a1*b1 and QCRS a0*b1-a1*b0
XDOT:   DB      LA0,LB0,QMUL       ; a0*b0
        DB      LA1,LB1,QMUL,QADD+QRET  ; dot
XCRS:   DB      LA0,LB1,QMUL       ; a0*b1
        DB      LA1,LB0,QMUL,QSUB+QRET  ; cross
; QVEC: the vector a
XVEC:   DB      LA0,LA1,QRET       ; x y
; QDIF: from the point a to the point b
XDIF:   DB      LB0,LA0,QSUB       ; dx
        DB      LB1,LA1,QSUB+QRET       ; dx dy
; QCENT: QUNIT from centre to centre, then r of a less r of b; ERR 06 when they are concentric (within TL)
XCENT:  DB      QUNIT,LT3,LTL,QSUB,QE6N ; -
        DB      LA2,LB2,QSUB+QRET       ; e
; QWAY: x2 x1 y2 y1 -> w*w; b = w: from (x1,y1) to (x2,y2)
XWAY:   DB      QSUB,SB1,QSUB,SB0  ; -
        DB      LB0,LB1                 ; wx wy
; (fall into XSS)
; QSS: length of a vector, squared.  QHYP: length of a vector
XSS:    DB      QSQ,QSWP,QSQ,QADD+QRET ; x^2+y^2
XHYP:   DB      QSS,QSQRT+QRET     ; length
; QFAR: is a vector longer than 1 um?  (no square root)
XFAR:   MOV     A,M             ; most are: exponent 78H is 2 um and more
        ADI     80H-78H
        MOV     C,A
        LDAX    D
        ADI     80H-78H
        ORA     C
        JM      XFAR1
        DB      CALC,QSS,QMU,QSQ,QSUB+QRET ; -1um^2
XFAR1:  DB      CALC,QDRP,QABS+QRET     ; |x|
; QALNG: a0 a1 moved by k times b0 b1, k from the stack.
XALNG:  DB      QDUP,LB0,QMUL,LA0       ; k k*b0 a0
        DB      QADD,SA0                ; k
        DB      LB1,QMUL,LA1            ; k*b1 a1
        DB      QADD,SA1,QRET           ; -
; QROTV: a0 a1 turned by b0 degrees; then b0 b1 = the old b1 b2
XROTV:  DB      LB1,LB2            ; x y
        DB      LB0,QSIN,LB0,QCOS,QSB   ; x y           b = sine, cosine:
        DB      QCRS,QDOT,QSA           ; x y           cross is x', dot is y'
; (fall into XSB)
; QSB: b0 b1 = a vector
XSB:    DB      SB1,SB0,QRET            ; -
; QLEG: how far from its foot a line crosses a circle whose centre lies t2 off, of radius
; t3 (the sign does not matter): the other leg of a right triangle.  They miss by g:
; ERR 06 when by more than 1 um; when they cross by no more than TL (1 um as a rule)
; they touch: 0, and t2 = t3 with its own sign
XLEG:   DB      QMU,QOVR,QSUB,QE6N ; g
        DB      LTL,QADD                ; g+tl
        DB      QJN             ; -
        DB      XLEG1-$
        DB      LT3,LT2,QSIG,ST2        ; -
XLEG1:  DB      LT3,LT2,QSUB            ; r-e
        DB      LT3,LT2,QADD            ; r-e r+e
        DB      QMUL,QSQRT+QRET         ; h

; QE6D: takes two numbers, ERR 06 when they are more than 1 um apart
XE6D:   DB      QSUB,QABS,QMU,QSUB,QNEG ; room
        DB      QE6N+QRET               ; -
