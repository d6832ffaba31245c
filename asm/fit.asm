; fit.asm - smooth curves through nodes: biarcs (language.md, section 5)
; Offers: SFIT FITEND
; Uses:   cut (ITEM3 GETR CPYEL FITN), parser, calc
; Room:   430 bytes
;
; Node 2 is the last node, node 1 the one before.  The span from 1 to 2 goes out when both
; tangents are known, and node 2 becomes node 1 as well.  So a curve of any length needs
; but two nodes; the one that arrives waits on the float stack meanwhile.
;
; A biarc from P (unit tangent t) to Q (unit tangent u): with v = Q-P and
; d = v*v / (v*(t+u) + sqrt((v*(t+u))^2 + |t-u|^2 v*v)) its arcs meet in the joint
; M = (P+Q + d(t-u)) / 2.  Each arc is found from its node, tangent and w = M - node:
; r = w*w / 2(t x w), the centre lies r to the left of the node.

; SFIT - statement: FIT point; FIT point, angle
SFIT:   CALL    EVPNT
        RST     5
        DB      LA0,LA1,QEND    ; x y
        RST     6
        PUSH    PSW
        JZ      SFIT1
        RST     4
        DB      CCOMMA
        CALL    EVNUM
SFIT1:  RST     7
        RST     5               ; (leaves a0 alone)
        DB      LSC,QMUL,QDUP,ST3,QSWP ; y x    t2 t3 = node that arrives
        DB      LSC,QMUL,QDUP,ST2,QEND ; y x
        POP     PSW             ; Z: no angle
        JZ      SFIT2
        RST     5
        DB      LA0,QSIN,LA0,QCOS ; y x v u
        DB      QJMP
        DB      SFIT3-$
SFIT2:  RST     5
        DB      Q0,Q0           ; y x v u
SFIT3:  DB      QEND
        LDA     FITN
        ORA     A
        JZ      SFIT4
        RST     5
        DB      LT2,L2X,QSUB,SB0 ; y x v u      b = w
        DB      LT3,L2Y,QSUB,SB1
        DB      LB0,LB1,QFAR,QJN ; y x v u      within 1 um: the same node
        DB      SFIT6-$
        DB      QEND
        LDA     FITN
        DCR     A
        CNZ     MIDDLE
        CALL    NODE
        RST     5
        DB      L2U,L2V,QMAX,QJZ ; -
        DB      SFIT5-$
        DB      QEND
        JMP     SPAN
SFIT4:  CALL    NODE            ; the first
        JMP     SPAN3
SFIT5:  DB      QEND
        MVI     A,2             ; the next node will tell its tangent
        JMP     FITN1
SFIT6:  DB      QRET

; NODE - the node that waits on the float stack becomes node 2
; Clobbers all
NODE:   CALL    GETR
        RST     5
        DB      S2U,S2V,S2X,S2Y ; -
        DB      LNR,S2R,QRET    ; -

SPAN2:  DB      QEND            ; (for SPAN: tangent 1 mirrors tangent 2)
        CALL    MIRROR
        RST     5
        DB      S1U,S1V,QJMP    ; -
        DB      SPAN1-$

; MIDDLE - node 2 gets the tangent of the circle through node 1, it, and the node that arrives;
;          then the span to it goes out
; In:  t2 t3 = node that arrives, b = w: to it from node 2   Out: ERR 06 when it is node 1
; Clobbers all
MIDDLE: RST     5
        DB      LT2,L1X,QSUB    ; dx
        DB      LT3,L1Y,QSUB    ; dx dy
        DB      QFAR,QE6N       ; -
        DB      L2X,L1X,QSUB,SA0 ; -            a = v
        DB      L2Y,L1Y,QSUB,SA1 ; -
        DB      LA0,LA1,QSS ; v*v
        DB      LB0,LB1,QSS,QDIV,ST4 ; -       t4 = v*v/(w*w)
        DB      LA0,LB0,LT4,QMUL,QADD ; x
        DB      LA1,LB1,LT4,QMUL,QADD ; x y     v + w * t4, along v/(v*v) + w/(w*w)
        DB      QUNIT,LA0,S2U,LA1,S2V,QEND ; -
; (fall into SPAN)

; SPAN - the biarc from node 1 to node 2 goes out; node 2 becomes node 1
; In:  nodes 1 and 2, tangent 2 known   Out: FITN = 1; ERR 06   Clobbers all
SPAN:   RST     5
        DB      L1U,L1V,QMAX,QJZ ; -
        DB      SPAN2-$
SPAN1:  DB      QEND
        CALL    CHORD
        RST     5
        DB      QDUP,QSQ        ; along along^2
        DB      L2U,L1U,QSUB,QDUP,SB0,QSQ ; along along^2 ..    b = u-t
        DB      L2V,L1V,QSUB,QDUP,SB1,QSQ
        DB      QADD,LT1,QMUL   ; along along^2 |u-t|^2*v*v
        DB      QADD,QSQRT,QADD ; below
        DB      QDUP,QNEAR,QSUB,QE6N ; below
        DB      L1X,L2X,QADD,SA0 ; below        a = P+Q
        DB      L1Y,L2Y,QADD,SA1
        DB      LT1,QSWP,QDIV,QREFL ; -         a = P+Q + d*(t-u)
        DB      LA0,QHALF,QMUL,LA1,QHALF,QMUL ; mx my
        DB      QEND
        LXI     D,MNODE1
        CALL    FITCIR
        RST     5
        DB      L1U,SA0,L1V,SA1,QEND ; -
        CALL    FITPNT          ; the joint
        RST     5
        DB      L1U,L1V,QEND    ; mx my
        LXI     D,MNODE2
        CALL    FITCIR
SPAN3:  RST     5               ; (SFIT comes here with the first node)
        DB      L2X,SA0,L2Y,SA1,QEND ; -
        CALL    FITPNT
        LXI     D,MNODE2
        LXI     H,MNODE1
        CALL    CPYEL           ; (a byte too much, which nobody minds)
        MVI     A,1
FITN1:  STA     FITN
        RET

; FITEND - ends a curve: a last tangent that is not given mirrors the one before it about the chord;
;          two nodes without tangents have the chord's
; Clobbers all (in check mode A)
FITEND: CALL    CHKRET
        LDA     FITN
        CPI     2
        CZ      FITE1
        LXI     H,0
        SHLD    FITN            ; and FITSM
        RET
FITE1:  RST     5
        DB      L1U,L1V,QMAX,QJZ ; -
        DB      FITE3-$
FITE2:  DB      QEND
        CALL    MIRROR
        RST     5
        DB      S2U,S2V,QEND    ; -
        JMP     SPAN
FITE3:  DB      L2X,L1X,QSUB,S1U ; -            (its length does not matter: both arcs are flat)
        DB      L2Y,L1Y,QSUB,S1V ; -
        DB      QJMP
        DB      FITE2-$

; MIRROR - a tangent that is not known: the other one mirrored about the chord
; In:  nodes 1 and 2, the unknown tangent is 0 0   Out: on the float stack y x   Clobbers all
MIRROR: CALL    CHORD
        RST     5
        DB      QDUP,QADD,LT1,QDIV,QREFL ; -
        DB      LA1,QNEG,LA0,QNEG,QRET  ; y x

; CHORD - prepares for a biarc
; In:  nodes 1 and 2   Out: b = v, t1 = v*v, a = t+u; on the float stack v*(t+u)   Clobbers all
CHORD:  RST     5
        DB      L2X,L1X,QSUB,SB0 ; -
        DB      L2Y,L1Y,QSUB,SB1 ; -
        DB      LB0,LB1,QSS,ST1 ; -
        DB      L1U,L2U,QADD,SA0 ; -
        DB      L1V,L2V,QADD,SA1 ; -
        DB      QDOT,QRET       ; along

; FITCIR - the arc between a node and the joint goes out; a flat one not: the point at its end
;          brings the chord
; In:  DE -> node, joint on the float stack   Out: 1U 1V = joint, FITSM   Clobbers all
FITCIR: LXI     H,MA
        CALL    CPYEL           ; a0 a1 = tangent, a2 b0 = node
        RST     5
        DB      S1V,S1U         ; -
        DB      L1V,LB0,QSUB,SB1 ; -
        DB      L1U,LA2,QSUB,SB0 ; -            b = w
        DB      LB0,LB1,QSS ; w*w
        DB      QDUP,QEPS,QMUL  ; w*w limit     r = 50 m
        DB      QMU,QDUP,QADD,QMAX ; w*w limit  or |t x w| = 2 um
        DB      QCRS,QDUP,ST0,QABS,QSUB ; w*w limit-|t x w|
        DB      QJN             ; w*w
        DB      FITC1-$
        DB      QDRP,QEND       ; -             (leaves A = 0)
FITC2:  STA     FITSM
        RET
FITC1:  DB      LT0,QDUP,QADD,QDIV ; r
        DB      LA2,QOVR,LA1,QMUL,QSUB ; r x
        DB      QOVR,LA0,QMUL   ; r x
        DB      L1V,LB1,QSUB,QADD,SA1 ; r x
        DB      SA0,SA2,QEND    ; -
        MVI     A,KCIR
        CALL    FITITM
        MVI     A,1
        JMP     FITC2

; FITPNT - the point a goes into the route, with the R of node 2
; Clobbers all
FITPNT: MVI     A,KPNT
; FITITM - the same for a value of kind A
FITITM: STA     VKIND
        RST     5
        DB      L2R,SNR,QEND    ; -
        JMP     ITEM3
