; geom.asm - the operations of language.md table 2.1, as calculator code
; Offers: BINOP, RUNBC, XCIR and the operations QDOT ... QROTV
; Uses:   calc, float, parser (SETK, CHKRET, error stubs)
; Room:   700 bytes
;
; The left operand stands in a0 a1 a2, the right one in b0 b1 b2, unused ones zero:
; a point is a circle of radius 0, a turn about O one about (0,0).  The result goes
; to a0 a1 a2.  Byte-code lines carry the float stack behind them, top last.

; BINOP - carries out an operator
; In:  B = kind of a, VKIND = kind of b, C = rank of the operator (parser.asm)
; Out: a0 a1 a2, VKIND; ERR 04 when the kinds do not combine   Clobbers all
BINOP:  CALL    CHKRET
        MOV     A,B
        CPI     KTURN
        JNC     ERKIND
        ADD     A
        ADD     A
        ADD     A
        MOV     E,A
        MOV     A,C
        RRC
        RRC
        RRC
        ORA     E
        LXI     H,VKIND
        ORA     M               ; A = rank*32 + left*8 + right
        LXI     H,GEOTAB
        MVI     C,NGEO
BIN1:   CMP     M
        INX     H
        MOV     E,M
        INX     H
        MOV     D,M
        INX     H
        JZ      BIN2
        DCR     C
        JNZ     BIN1
        JMP     ERKIND
BIN2:   MOV     A,D             ; kind*32 + page
        ANI     0E0H
        PUSH    PSW
        XRA     D
        MOV     D,A
        CALL    RUNBC
        POP     PSW
        RLC
        RLC
        RLC
        JMP     SETK

; RUNBC - runs byte-code that ends with QEND and a RET
; In:  DE -> byte-code   Clobbers all
RUNBC:  PUSH    D
        JMP     CALC

; Rows: rank*32 + left*8 + right, then byte-code + kind of the result * 2000H.
; Ranks: 1 comma, 2 #, 3 :, 4 +, 5 -, 6 *, 7 /
ONN     EQU KNUM*8+KNUM
ONP     EQU KNUM*8+KPNT
OPN     EQU KPNT*8+KNUM
OPP     EQU KPNT*8+KPNT
OPC     EQU KPNT*8+KCIR
OPS     EQU KPNT*8+KLIN
OPT     EQU KPNT*8+KTURN
OCN     EQU KCIR*8+KNUM
OCP     EQU KCIR*8+KPNT
OCC     EQU KCIR*8+KCIR
OCS     EQU KCIR*8+KLIN
OCT     EQU KCIR*8+KTURN
OSN     EQU KLIN*8+KNUM
OSP     EQU KLIN*8+KPNT
OSC     EQU KLIN*8+KCIR
OSS     EQU KLIN*8+KLIN
OST     EQU KLIN*8+KTURN
KN      EQU KNUM*2000H
KP      EQU KPNT*2000H
KC      EQU KCIR*2000H
KS      EQU KLIN*2000H
KT      EQU KTURN*2000H
RCOM    EQU 20H
RTRN    EQU 40H
RCOL    EQU 60H
RPLU    EQU 80H
RMIN    EQU 0A0H
RMUL    EQU 0C0H
RDIV    EQU 0E0H
RSTAR   EQU RMUL/32

GEOTAB: DB      RCOM+ONN
        DW      GPNT+KP
        DB      RCOM+OPP
        DW      GDIST+KN
        DB      RCOM+OPS
        DW      GPSDIS+KN
        DB      RCOM+OSP
        DW      GSPDIS+KN
        DB      RCOM+OSS
        DW      GANGLE+KN
        DB      RCOL+OPN
        DW      GCIR+KC
        DB      RCOL+OCN
        DW      GCONC+KC
        DB      RCOL+OSN
        DW      GPAR+KS
        DB      RCOL+OSP
        DW      GPARC+KS
        DB      RCOL+OSC
        DW      GPARC+KS
        DB      RCOL+OPP
        DW      GBELT+KS
        DB      RCOL+OCC
        DW      GBELT+KS
        DB      RCOL+OCP
        DW      GBELT+KS
        DB      RCOL+OPC
        DW      GBELT+KS
        DB      RCOL+ONP
        DW      GTURN+KT
        DB      RTRN+ONN
        DW      GPOLAR+KP
        DB      RTRN+OPN
        DW      GROTP+KP
        DB      RTRN+OCN
        DW      GROTP+KC
        DB      RTRN+OSN
        DW      GROTS+KS
        DB      RTRN+OPT
        DW      GROTP+KP
        DB      RTRN+OCT
        DW      GROTP+KC
        DB      RTRN+OST
        DW      GROTS+KS
        DB      RTRN+OPP
        DW      GBISEC+KS
        DB      RTRN+OPS
        DW      GFOOT+KP
        DB      RMUL+ONN
        DW      GMULT+KN
        DB      RMUL+OSS
        DW      GSXS+KP
        DB      RMUL+OSC
        DW      GSXC+KP
        DB      RMUL+OCS
        DW      GCXS+KP
        DB      RMUL+OCC
        DW      GCXC+KP
        DB      RMUL+OPN
        DW      GMULT+KP
        DB      RMUL+ONP
        DW      GNMULP+KP
        DB      RMUL+OPP
        DW      GDOT+KN
        DB      RDIV+ONN
        DW      GDIV+KN
        DB      RDIV+OPN
        DW      GDIV+KP
        DB      RDIV+OPS
        DW      GMIRR+KP
        DB      RDIV+OCS
        DW      GMIRR+KC
        DB      RDIV+OSS
        DW      GMIRS+KS
        DB      RDIV+OPP
        DW      GTHRU+KC
        DB      RPLU+ONN
        DW      GADD+KN
        DB      RPLU+OPP
        DW      GADD+KP
        DB      RMIN+ONN
        DW      GSUB+KN
        DB      RMIN+OPP
        DW      GSUB+KP
NGEO    EQU ($-GEOTAB)/3

; x,y: the point
GPNT:   DB      LB0,SA1,QRET            ; -
; P,P: distance
GDIST:  DB      QDIF,QHYP,SA0,QRET      ; -
; P,S and S,P: how far P lies to the right of S
GPSDIS: DB      QDOT,LB2,QSUB,SA0,QRET  ; -
GSPDIS: DB      QDOT,LA2,QSUB,SA0,QRET  ; -
; S,S: angle from the first direction to the second
GANGLE: DB      QDOT,QDUP,QJZ   ; cos
        DB      GANG2-$
        DB      QCRS,QSWP,QDIV,QATG     ; angle         or 180 off
        DB      QDOT,QJN        ; angle
        DB      GANG1-$
        DB      SA0,QRET                ; -
GANG1:  DB      Q180,QCRS,QSGN,QMUL     ; angle +-180
        DB      QADD,SA0,QRET           ; -
GANG2:  DB      QDRP,Q90,QCRS,QSGN,QMUL ; +-90
        DB      SA0,QRET                ; -

; P:D, C:D, P/P: a circle; S:D: the parallel to the right
GTHRU:  DB      QDIF,QHYP,QJMP  ; r
        DB      GCIR1-$
GCIR:
GCONC:  DB      LA2,LB0,QADD            ; r
GCIR1:  DB      QE5Z,SA2,QRET           ; -
GPAR:   DB      LA2,LB0,QADD,SA2,QRET   ; -
; S:P, S:C: the parallel that leaves C along its direction
GPARC:  DB      QDOT,LB2,QADD,SA2,QRET  ; -
; A:P: a turn
GTURN:  DB      LB0,SA1,LB1,SA2,QRET    ; -

; The belt line: alpha*xi + beta*yi + ri = gamma for both circles.  With d from
; centre to centre, e = r1-r2 and h = sqrt(d^2-e^2): alpha = (e*dx+h*dy)/d^2,
; beta = (e*dy-h*dx)/d^2.
GBELT:  DB      QDIF                    ; dx dy
        DB      QOVR,ST0,QDUP,ST1       ; dx dy
        DB      QHYP,QE6Z,ST3           ; -             t3 = d
        DB      LA2,LB2,QSUB,QDUP,ST2   ; e             t2 = e
        DB      QABS,LT3,QSUB           ; |e|-d
        DB      QTCH,QJN        ; -             apart?
        DB      GBEL1-$
        DB      LT2,QSGN,LT3,QMUL,ST2   ; -             touching: e = +-d
        DB      Q0,QJMP         ; h
        DB      GBEL2-$
GBEL1:  DB      LT3,LT2,QSUB            ; d-e
        DB      LT3,LT2,QADD,QMUL,QSQRT ; h
GBEL2:  DB      ST4,LT3,QSQ,ST3         ; -             t3 = d^2
        DB      LT2,LT1,QMUL            ; e*dy
        DB      LT4,LT0,QMUL,QSUB       ; e*dy-h*dx
        DB      LT3,QDIV,ST5            ; -             t5 = beta
        DB      LT2,LT0,QMUL            ; e*dx
        DB      LT4,LT1,QMUL,QADD       ; e*dx+h*dy
        DB      LT3,QDIV                ; alpha
        DB      QDUP,LA0,QMUL           ; alpha alpha*x1
        DB      LT5,LA1,QMUL,QADD       ; alpha alpha*x1+beta*y1
        DB      LA2,QADD,SA2            ; alpha
        DB      SA0,LT5,SA1,QRET        ; -

; D#A: polar point
GPOLAR: DB      LB0,QSIN,LA0,QMUL,SA1   ; -
        DB      LB0,QCOS,LA0,QMUL,SA0   ; -
        DB      QRET
; P#A, C#A, P#(A:P), C#(A:P)
GROTP:  DB      LA0,LB1,QSUB,SA0        ; -
        DB      LA1,LB2,QSUB,SA1        ; -             from the centre of the turn
        DB      QROTV                   ; -
        DB      LA0,LB1,QADD,SA0        ; -
        DB      LA1,LB2,QADD,SA1,QRET   ; -
; S#A, S#(A:P): gamma is kept as seen from the centre of the turn
GROTS:  DB      LA2,QCEN,QSUB           ; gamma'
        DB      QROTV                   ; gamma'
        DB      QCEN,QADD,SA2,QRET      ; -
; P#P: perpendicular bisector, the first point on its left
GBISEC: DB      QDIF                    ; dx dy
        DB      QOVR,QOVR,QHYP,QE6Z     ; dx dy d
        DB      QSWP,QOVR,QDIV          ; dx d beta
        DB      LA1,LB1,QADD,QHALF,QMUL ; dx d beta ym
        DB      QOVR,QMUL,SA2,SA1       ; dx d          a2 = beta*ym
        DB      QDIV                    ; alpha
        DB      LA0,LB0,QADD,QHALF,QMUL ; alpha xm
        DB      QOVR,QMUL,LA2,QADD,SA2  ; alpha
        DB      SA0,QRET                ; -
; P#S: foot; P/S, C/S: mirror image; S/S: mirrored and reversed
GFOOT:  DB      QDOT,LB2,QSUB           ; e
        DB      QREFL,QRET              ; -
GMIRR:  DB      QDOT,LB2,QSUB           ; e
        DB      QDUP,QADD               ; 2e
        DB      QREFL,QRET              ; -
GMIRS:  DB      QDOT,QDUP,QADD          ; 2c            c = n1*n2
        DB      LA2,QOVR,LB2,QMUL       ; 2c gamma 2c*g
        DB      QSUB,SA2                ; 2c
        DB      QREFL,QRET              ; -

; D*D, P*D, D*P, P*P; D/D, P/D; sums and differences (a1, b1 of a number are 0)
GNMULP: DB      LB1,LA0,QMUL,SA1        ; -
        DB      LB0,LA0,QMUL,SA0,QRET   ; -
GMULT:  DB      LA1,LB0,QMUL,SA1        ; -
        DB      LA0,LB0,QMUL,SA0,QRET   ; -
GDOT:   DB      QDOT,SA0,QRET           ; -
GDIV:   DB      LA1,LB0,QDIV,SA1        ; -
        DB      LA0,LB0,QDIV,SA0,QRET   ; -
GADD:   DB      LA0,LB0,QADD,SA0        ; -
        DB      LA1,LB1,QADD,SA1,QRET   ; -
GSUB:   DB      LA0,LB0,QSUB,SA0        ; -
        DB      LA1,LB1,QSUB,SA1,QRET   ; -

; S*S: crossing by Cramer's rule
GSXS:   DB      QCRS                    ; det
        DB      QDUP,QABS,QNEAR,QSUB,QE6N ; det          parallel?
        DB      LA0,LB2,QMUL            ; det
        DB      LA2,LB0,QMUL,QSUB       ; det y*det
        DB      QOVR,QDIV,QSWP          ; y det
        DB      LA2,LB1,QMUL            ; y det
        DB      LA1,LB2,QMUL,QSUB       ; y det x*det
        DB      QSWP,QDIV               ; y x
        DB      SA0,SA1,QRET            ; -

; C1*C2: the crossing of C1 with the line through both crossings, whose right
; normal is the unit vector u from centre to centre, at c = (d^2+r1^2-r2^2)/2d
; from the first centre.
GCXC:   DB      QDIF                    ; dx dy
        DB      QOVR,QOVR,QHYP,ST3      ; dx dy         t3 = d
        DB      QMU,LT3,QSUB            ; dx dy 1um-d   concentric?
        DB      QNEG,QE6N               ; dx dy
        DB      LT3,QDIV,ST1            ; dx            t1 = uy
        DB      LT3,QDIV,ST0            ; -             t0 = ux
        DB      LA2,LB2,QSUB            ; r1-r2
        DB      LA2,LB2,QADD,QMUL       ; r1^2-r2^2
        DB      LT3,QDIV,LT3,QADD       ; 2c
        DB      QHALF,QMUL,QNEG,ST2     ; -             t2 = -c
        DB      LT3,LA2,QABS            ; d |r1|
        DB      LB2,QABS,QADD,QSUB      ; d-|r1|-|r2|
        DB      LA2,QABS                ; outer |r1|
        DB      LB2,QABS,QSUB,QABS      ; outer ||r1|-|r2||
        DB      LT3,QSUB,QMAX           ; gap           they miss by this
        DB      LA0,SB0,LA1,SB1         ; gap
        DB      LB2,QSGN,LA2,QMUL,SB2   ; gap           the crossing's sign
        DB      LT0,SA0,LT1,SA1         ; gap
        DB      QJMP
        DB      XCIR-$
; C*S = S*-C
GCXS:   DB      LA0,LB0,SA0,SB0         ; -
        DB      LA1,LB1,SA1,SB1         ; -
        DB      LA2,LB2,SA2,QNEG,SB2    ; -
; S*C: foot of the centre, then along the line; to the left of S and C turning
; counter-clockwise that is forward
GSXC:   DB      QDOT,LA2,QSUB           ; e             centre right of S
        DB      QDUP,ST2,QABS           ; |e|           t2 = e
        DB      LB2,QABS,QSUB           ; gap
; XCIR - crossing of a line, given by its normal a0 a1 and the distance t2 of the
; circle's centre to its right, with the circle b; on the stack: how far they miss
XCIR:   DB      QTCH,QJN        ; -
        DB      XCIR1-$
        DB      Q0,QJMP         ; h
        DB      XCIR2-$
XCIR1:  DB      LB2,LT2,QSUB            ; r-e
        DB      LB2,LT2,QADD,QMUL,QSQRT ; h
XCIR2:  DB      LB2,QSGN,QMUL,ST1       ; -
        DB      LB1,LT2,LA1,QMUL,QSUB   ; y of the foot
        DB      LT1,LA0,QMUL,QADD       ; y
        DB      LB0,LT2,LA0,QMUL,QSUB   ; y x of the foot
        DB      LT1,LA1,QMUL,QSUB       ; y x
        DB      SA0,SA1,QRET            ; -

; Operations of the calculator that geometry adds (entries in CALC's table)

; QDOT a0*b0+a1*b1 and QCRS a0*b1-a1*b0
XDOT:   RST     5
        DB      LA0,LB0,QMUL            ; a0*b0
        DB      LA1,LB1,QMUL,QADD,QRET  ; dot
XCRS:   RST     5
        DB      LA0,LB1,QMUL            ; a0*b1
        DB      LA1,LB0,QMUL,QSUB,QRET  ; cross
; QDIF: from the point a to the point b
XDIF:   RST     5
        DB      LB0,LA0,QSUB            ; dx
        DB      LB1,LA1,QSUB,QRET       ; dx dy
; QHYP: length of a vector
XHYP:   RST     5
        DB      QSQ,QSWP,QSQ,QADD       ; x^2+y^2
        DB      QSQRT,QRET              ; length
; QFAR: is a vector longer than 1 um?  (no square root)
XFAR:   RST     5
        DB      QSQ,QSWP,QSQ,QADD       ; x^2+y^2
        DB      QMU,QSQ,QSUB,QRET       ; -1um^2
; QCEN: the centre of a turn along the normal a0 a1
XCEN:   RST     5
        DB      LA0,LB1,QMUL            ; a0*x
        DB      LA1,LB2,QMUL,QADD,QRET  ; a0*x+a1*y
; QREFL: a0 a1 moved by -k times b0 b1, k from the stack
XREFL:  RST     5
        DB      LA0,QOVR,LB0,QMUL       ; k a0 k*b0
        DB      QSUB,SA0                ; k
        DB      LA1,QSWP,LB1,QMUL       ; a1 k*b1
        DB      QSUB,SA1,QRET           ; -
; QROTV: a0 a1 turned by b0 degrees
XROTV:  RST     5
        DB      LB0,QCOS,ST0,LB0,QSIN,ST1 ; -
        DB      LA0,LT1,QMUL            ; x*s
        DB      LA1,LT0,QMUL,QADD       ; y'
        DB      LA0,LT0,QMUL            ; y' x*c
        DB      LA1,LT1,QMUL,QSUB       ; y' x'
        DB      SA0,SA1,QRET            ; -
; QTCH: two curves miss by g: ERR 06 when by more than 1 um, negative left when
; they cross by more than TL (1 um as a rule), else they touch
XTCH:   RST     5
        DB      QMU,QOVR,QSUB,QE6N      ; g
        DB      LTL,QADD,QRET           ; g+tl
; QSGN: 1, or -1 for a negative number
XSGN:   RST     5
        DB      QJN             ; -
        DB      XSGN1-$
        DB      Q1,QRET                 ; 1
XSGN1:  DB      Q1,QNEG,QRET            ; -1
; QMAX: the greater of two
XMAX:   RST     5
        DB      QOVR,QOVR,QSUB          ; a b a-b
        DB      QJN             ; a b
        DB      XMAX1-$
        DB      QDRP,QRET               ; a
XMAX1:  DB      QSWP,QDRP,QRET          ; b
; QE6N: takes a number, ERR 06 when it is negative
XE6N:   RST     5
        DB      QJN             ; -
        DB      XE6N1-$
        DB      QRET
XE6N1:  DB      QEND
        JMP     ERGEO
; QE6D: takes a distance, ERR 06 when it is more than 1 um
XE6D:   RST     5
        DB      QABS,QMU,QSWP,QSUB      ; room
        DB      QE6N,QRET               ; -
; QE6Z, QE5Z: leave the number, ERR 06 or 05 when it is (nearly) zero
XE6Z:   RST     5
        DB      QDUP,QABS,QNEAR,QSUB     ; x room
        DB      QJN
        DB      XE6N1-$
        DB      QRET            ; x
XE5Z:   RST     5
        DB      QDUP,QABS,QNEAR,QSUB     ; x room
        DB      QJN
        DB      XE5Z1-$
        DB      QRET            ; x
XE5Z1:  DB      QEND
        JMP     ERRNG
