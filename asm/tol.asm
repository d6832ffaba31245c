; tol.asm - TOL: few arcs for many nodes, spans of a curve are held back and tried as one (curves.md)
; Offers: STOL HOLD FLUSH
; Uses:   calc consts corner fit float geom parser route start
; Room:   215 bytes
;
; With TOL the span that ends in node 1 is held back: KEPT is the node where it begins, HELD
; has the places of the nodes behind that one, node 1's the last.  When node 2 comes and the
; biarc from KEPT to it passes near all of them, that biarc is held back instead; else the held
; span goes out, and node 1 becomes KEPT.  KEPT, node 1 and node 2 lie side by side in memory and
; change places, since the byte-code has registers for nodes 1 and 2 only.

; STOL - statement: TOL number
STOL:   CALL    FITEND
        CALL    EVNUM
        DB      CHKEND
        DB      CALC,LA0,QSQRT,QSQ,STO,QRET ; -      (the root refuses what is negative)

; HOLD - the span from node 1 to node 2 goes out, or is held back; node 2 becomes node 1 (SPAN ends here)
; In:  nodes 1 and 2, their tangents   Out: FITN = 1; ERR 06   Clobbers all
HOLD:   LDA     MTO
        ORA     A
        JZ      SPOUT
        CALL    SWAP            ; node 1 = KEPT
        CALL    TRY
        CNZ     HOLD1           ; what is held goes out, and KEPT = node 1
        CALL    SWAP
        LHLD    HELDN
        MVI     H,HELD/256
        LXI     D,MNODE2
        CALL    CPYPL
        SHLD    HELDN
        JMP     NODNXT

HOLD1:  CALL    SWAP            ; (HOLD exchanges them once more)
; (fall into FLUSH)

; FLUSH - the span that is held back, if there is one, goes out
; Out: HELDN = 0, KEPT = node 1   Clobbers all
FLUSH:  XRA     A
        LXI     H,HELDN
        CMP     M
        MOV     M,A
        RZ
        CALL    ROTATE
        CALL    ROTATE          ; node 1 = KEPT, node 2 = node 1
        CALL    SPOUT
; (fall into ROTATE)

; ROTATE - KEPT goes behind node 2; node 1 goes where it was, and node 2 to node 1
; Clobbers all
ROTATE: MVI     C,2*NODSIZ
        DB      SKIP2           ; skips the MVI

; SWAP - exchanges KEPT and node 1
; Clobbers all
SWAP:   MVI     C,NODSIZ
        LXI     D,KEPT
        LXI     H,MNODE1
        JMP     EXCHC           ; (calc: exchanges C bytes, the first one first)

; TRY - may the span from node 1 to node 2 be held back?
; In:  HELD   Out: Z: yes, all nodes in HELD lie near it   Clobbers all
TRY:    LDA     HELDN
        DCR     A
        CPI     15*PLCSIZ
        RNC                     ; none, or more than 15
        DB      CALC,QCHRD,QMU,QDOT,QSUB,QJN ; v*v   (not of half a circle, where rounding decides)
        DB      TRY1-$
        DB      QDRP+QRET       ; -             begins or ends backwards (it leaves Z clear)
TRY1:   DB      QBIAR,QEND      ; -
        LXI     D,MNODE1
        CALL    ARCW            ; w*w
        DB      CALC,QMIRR,ST2,ST3 ; -          t2 t3 = tangent at the joint
        DB      LMX,L1X,QADD,LT2,QMUL ; m
        DB      LMY,L1Y,QADD,LT3,QMUL,QADD,SO2,QEND ; - o2 = how far the joint lies along it
        LXI     D,HELD
TRY2:   LXI     H,MT0
        CALL    CPYPL           ; t0 t1 = n
        PUSH    D
        DB      CALC,LO2,LT0,LT2,QMUL,LT1,LT3,QMUL,QADD ; m n
        DB      QSUB,SO1,QEND   ; -             o1 = how far n lies before the joint
        LXI     D,MNODE1
        LDA     MO1+1
        ORA     A
        JP      TRY3            ; before the joint: the arc from node 1
        MVI     E,MNODE2 & 255
TRY3:   CALL    ARCW
        DB      CALC,QCRS,QSWP,QDIV ; k             half the curvature
        DB      LT0,LT4,LT1,LT5,QWAY ; k q*q    b = q: to n from the arc's node
        DB      LTO,QSQ,QSUB,QOVR,ST0,QMUL ; k(q*q-d*d)  t0 = k
        DB      QCRS,QSUB,ST1   ; -             t1 = g = k(q*q-d*d)-t*q
        DB      LT1,QABS,LTO,QSUB,QJN ; -       |g|-d
        DB      TRY5-$
; |g| > d: more than d off; but nothing lies too far inside an arc whose radius is below d
        DB      LT0,LTO,QSQ,QMUL,QDBL ; 2kd*d
        DB      LT1,QNEG,QSIG,LT1,QABS,QSUB ; +-2kd*d-|g|  + inside
        DB      QJN             ; -
        DB      TRY4-$
TRY5:   DB      QDOT,LO1,QSIG,QJN ; -           past the node, the wrong way
        DB      TRY4-$
        DB      QEND
        POP     D
        LDA     HELDN
        CMP     E
        JNZ     TRY2
        RET
TRY4:   DB      QEND
        POP     D
        INR     A
        RET
