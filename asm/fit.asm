; fit.asm - smooth curves through nodes: biarcs (language.md, section 5) (curves.md)
; Offers: NODSIZ SFIT SPOUT NODNXT FITEND XCHRD XMIRR XBIAR ARCW
; Uses:   [spans] calc consts corner cut float geom parser route start value
; Room:   367 bytes
;
; Node 2 is the last node, node 1 the one before.  The span from 1 to 2 goes out when both
; tangents are known, and node 2 becomes node 1.  So a curve of any length needs two nodes in
; memory; the node that arrives waits on the float stack.
;
; A biarc from P (unit tangent t) to Q (unit tangent u): with v = Q-P and
; d = v*v / (v*(t+u) + sqrt((v*(t+u))^2 + |t-u|^2 v*v)) its arcs meet in the joint
; M = P + (v + d(t-u)) / 2.  Each arc is found from its node, tangent and w = M - node:
; r = w*w / 2(t x w), the centre lies r to the left of the node.  What waits in MX, MY is M - P:
; a joint in the drawing's coordinates would lose the last bits of w, and r is 2r^2/w^2 times as
; sensitive as they.

NODSIZ  EQU 25          ; bytes of a node: place, tangent, offset

; SFIT - statement: FIT point; FIT point, angle
SFIT:   CALL    EVPNT
        DB      CALC,QVEC,QEND  ; x y
        DB      PEEK
        PUSH    PSW             ; Z: no angle
        JZ      SFIT1
        DB      EXPECT,CCOMMA
        CALL    EVNUM
SFIT1:  DB      CHKEND
        DB      CALC            ; (leaves a0 alone)
        DB      QSCL,QDUP,ST3,QSWP ; y x        t2 t3 = node that arrives
        DB      QSCL,QDUP,ST2   ; y x
        DB      Q0,Q0,QEND      ; y x v u
        POP     PSW
        PUSH    PSW
        JZ      SFIT2
        DB      CALC,QDRP,QDRP,LA0,QSIN,LA0,QCOS,QEND ; y x v u
SFIT2:  LDA     FITN
        ORA     A
        JZ      SFIT3
        DB      CALC,LT2,L2X,LT3,L2Y,QWAY ; y x v u w*w      b = w: to it from node 2
        DB      ST5,LB0,LB1,QFAR,QJN ; y x v u         within 1 um: the same node
        DB      SFIT4-$
        DB      QEND
        LDA     FITN
        DCR     A
        CNZ     MIDDLE
        CALL    TAKE
        POP     PSW
        JNZ     SPAN
        MVI     A,2             ; the next node will tell its tangent
        JMP     FITN1
SFIT3:  CALL    TAKE            ; the first
        POP     PSW
        JMP     SPOUT2
SFIT4:  DB      QEND
        POP     PSW
        RET

; TAKE - the node that waits on the float stack becomes node 2
; Clobbers all
TAKE:   CALL    GETR
        DB      CALC,S2U,S2V,S2X,S2Y ; -
        DB      LNR,S2R,QRET    ; -

; LAST - the last node's tangent, which is not given, mirrors the one before it about the chord;
;        two nodes without tangents have the chord's.  Then the span to it goes out
; In:  nodes 1 and 2   Clobbers all
LAST:   DB      CALC,QCHRD,QMIRR ; y x          b = chord
        DB      L1U,L1V,QFAR,QJN ; y x
        DB      LAST1-$
        DB      QJMP
        DB      MIDD1-$
LAST1:  DB      QDRP,QDRP,LB1,LB0,QJMP ; y x    (its length does not matter: both arcs are flat)
        DB      MIDD1-$

; MIDDLE - node 2 gets the tangent of the circle through node 1, it, and the node that arrives;
;          then the span to it goes out
; In:  b = w: to the node that arrives from node 2, t5 = w*w   Out: ERR 06 when it is node 1
; Clobbers all
MIDDLE: DB      CALC,QXCH,LT5   ; w*w
        DB      L1X,L2X,L1Y,L2Y,QWAY ; w*w v*v  a = w, b = -v: to node 1 from node 2
        DB      QDIF,QFAR,QE6N  ; w*w v*v
        DB      QDIV,QNEG,QALNG ; -             a = w + v*(w*w)/(v*v)
        DB      QVEC,QUNIT,LA1,LA0 ; y x
MIDD1:  DB      S2U,S2V,QEND    ; -
; (fall into SPAN)

; SPAN - the biarc from node 1 to node 2 goes out, or is held back; node 2 becomes node 1
; In:  nodes 1 and 2, tangent 2 known   Out: FITN = 1; ERR 06   Clobbers all
SPAN:   LDA     MNODE1+10
        LXI     H,MNODE1+15
        ORA     M
        CZ      SPAN1
        JMP     HOLD

SPAN1:  DB      CALC,QCHRD,QMIRR,S1U,S1V,QRET ; - tangent 1 mirrors tangent 2

; SPOUT - the biarc from node 1 to node 2 goes out; node 2 becomes node 1
; Out: FITN = 1; ERR 06   Clobbers all
SPOUT:  DB      CALC,QCHRD,QBIAR,QEND ; -
        LXI     D,MNODE1
        CALL    FITCIR
        DB      CALC,LMX,L1X,QADD ; x             the joint
        DB      LMY,S1U         ; x             (MY is kept where the tangent is used up)
        DB      LMY,L1Y,QADD,QEND ; x y
        CALL    FITPNT
        DB      CALC,L1U,SMY,QEND ; -
        LXI     D,MNODE2
        CALL    FITCIR
SPOUT2: DB      CALC            ; (SFIT comes here with the first node)
        DB      L2X,L2Y,QEND    ; x y
        CALL    FITPNT
; NODNXT - node 2 becomes node 1 (HOLD comes here when the span is held back)
; Out: FITN = 1   Clobbers all
NODNXT: LXI     D,MNODE2
        LXI     H,MNODE1
        MVI     A,NODSIZ
        CALL    COPY
        MVI     A,1
FITN1:  STA     FITN            ; (SFIT comes in here with A = nodes)
        RET

; FITEND - ends a curve
; Clobbers all (in check mode A)
FITEND: CALL    CHKRET
        LDA     FITN
        CPI     2
        CZ      LAST
        CALL    FLUSH
        LXI     H,0
        SHLD    FITN            ; and FITSM
        RET

; Operations of the calculator that FIT adds, byte-code

; QCHRD: prepares for a biarc from node 1 to node 2: b = v, a = t+u (one tangent and 0 0: the one)
XCHRD:  DB      L1U,L2U,QADD    ; u
        DB      L1V,L2V,QADD,QSA ; -
        DB      L2X,L1X,L2Y,L1Y,QWAY+QRET ; v*v

; QMIRR: b*b -> y x: the vector a mirrored about b; behind QCHRD: the tangent that is not known, the
; other one mirrored about the chord
XMIRR:  DB      QDOT,QDBL,QNEG,QSWP,QDIV,QALNG ; -
        DB      LA1,QNEG,LA0,QNEG+QRET  ; y x

; QBIAR: behind QCHRD: where the arcs of the biarc meet, MX MY = from node 1 to M; ERR 06
XBIAR:  DB      QDUP,ST1,QDOT,QDUP,QSQ ; v*v along along^2
        DB      QXCH,L1U,L2U,L1V,L2V,QWAY ; v*v along along^2 |t-u|^2  a = v, b = t-u
        DB      LT1,QMUL,QADD,QSQRT,QADD ; v*v below
        DB      QDUP,QNEAR,QSUB,QE6N ; v*v below
        DB      QDIV,QALNG      ; -             a = v + d*(t-u)
        DB      LA0,QHALF,QMUL,SMX,LA1,QHALF,QMUL,SMY,QRET ; -

; ARCW - from a node to the joint
; In:  DE -> place and tangent, node 1, MX MY   Out: t4 t5 = place, a = tangent, b = w; on the float stack w*w
; Clobbers all
ARCW:   LXI     H,MT4
        CALL    CPYEL           ; (a byte too much, which does no harm)
        DB      CALC,LMX,LT4,L1X,QSUB,LMY,LT5,L1Y,QSUB,QWAY+QRET ; w*w

; FITCIR - the arc between a node and the joint goes out; a flat one not: the point at its end
;          brings the chord
; In:  DE -> node, node 1, MX MY   Out: FITSM   Clobbers all but J
FITCIR: CALL    ARCW
        DB      CALC,QDUP,QEPS,QMUL ; w*w limit     r = 50 m
        DB      QMU,QDBL,QMAX   ; w*w limit  or |t x w| = 2 um
        DB      QCRS,QDUP,ST0,QABS,QSUB ; w*w limit-|t x w|
        DB      QJN             ; w*w
        DB      FITC1-$
        DB      QDRP,QEND       ; -             (leaves A = 0)
FITC2:  STA     FITSM
        RET
FITC1:  DB      LT0,QDBL,QDIV,SA2 ; -      r
        DB      LT4,LA2,LA1,QMUL,QSUB ; x
        DB      LA2,LA0,QMUL,LT5,QADD,QEND ; x y
        MVI     A,KCIR
        CALL    FITITM          ; (CORDON comes last: its QRET leaves CY set)
        LDA     FITSM
        RAL                     ; 0, 1, 3, 7 ... 255
        JMP     FITC2

; FITPNT - a point goes into the route, with the R of node 2
; In:  x y on the float stack   Clobbers all
FITPNT: MVI     A,KPNT
; FITITM - the same for a value of kind A: a2   Clobbers all
FITITM: STA     VKIND
        DB      CALC,QSA,L2R,SNR,QEND ; -
        JMP     ITEMR
