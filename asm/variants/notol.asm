; notol.asm - no TOL: each span of a curve goes out at once
; Offers: HOLD FLUSH
; Uses:   calc fit
; Room:   0 bytes

; HOLD - the span from node 1 to node 2 goes out; node 2 becomes node 1 (SPAN ends here)
; In:  nodes 1 and 2, their tangents   Out: FITN = 1; ERR 06   Clobbers all
HOLD    EQU SPOUT

; FLUSH - nothing is held back
; Clobbers nothing
FLUSH   EQU ODRP                ; (a RET)
