; tape.asm - moves in whole micrometres, as 3B blocks (tape-3b.md)
; Offers: MOVE PUTBLK PUTB2 XRND XVK QUAD SETZG
; Uses:   calc consts float io io_disk io_punch io_tty lexer start
; Room:   220 bytes
;
; The wire stands at W, the move goes to V; everything is made from these rounded
; values; ARC (arc_3b.asm, arc_nodrift.asm) does the arcs.

TGAX    EQU CWORK+18    ; block: letter of the count direction
TZLET   EQU CWORK+19    ; L, N (for NR) or S (for SR)
TZNUM   EQU CWORK+20    ; its digit

;! TZLET == TGAX+1 -- PUTBLK takes two letters at once

; MOVE - a straight move of the wire
; In:  W, V   Out: W = V   Clobbers all
MOVE:   DB      CALC,LVX,LWX,QSUB,QDUP,SA0,QABS,SBX ; -
        DB      LVY,LWY,QSUB,QDUP,SA1,QABS,SBY ; -
        DB      LBX,LBY,QMAX,SBJ ; -
        DB      QHALF,LA0,QSIG,LA1,QSIG ; 1/2   x = y: along Y in quadrants 1 and 3
        DB      LBY,QADD,LBX,QSUB,ST0,QEND ; -
        CALL    QUAD
        MVI     B,CLTL
        CALL    SETZG
; (fall into PUTBLK)

; PUTBLK - lists and punches a block; J = 0 is none
; In:  BX BY BJ, TGAX TZLET TZNUM, V   Out: W = V; ERR 10 when too long   Clobbers all
PUTBLK: DB      CALC,LVX,SWX,LVY,SWY ; -
        DB      Q8DIG           ; 99999999
        DB      LBX,LBY,QMAX,LBJ,QMAX ; 99999999 max
        DB      QSUB,QJN        ; -
        DB      PUTB4-$
        DB      LBJ,QJZ         ; -
        DB      PUTB3-$
        DB      QEND
        LXI     H,BLKNO
        MOV     A,M             ; decimal, low two digits first
        ADI     1
        DAA
        MOV     M,A
        INX     H
        MOV     A,M
        ACI     0
        DAA
        MOV     M,A
        PUSH    PSW
        CALL    PUT2D
        POP     PSW
        DCX     H
        MOV     A,M
        ACI     0               ; after 9999 comes 0001
        MOV     M,A
        CALL    PUT2D
        MVI     A,CBLANK
        DB      PUTC
        CALL    PUNON
        LXI     H,MBX
        LXI     B,8*256+3       ; digits, numbers
PUTB1:  MVI     A,CLTB
        DB      PUTC
        CALL    PRNUM
        DCR     C
        JNZ     PUTB1
        MVI     A,CLTG
        DB      PUTC
        LHLD    TGAX            ; and TZLET
        MOV     A,L
        DB      PUTC
        MOV     A,H
        DB      PUTC
        CPI     CLTL
        MVI     A,CLTR
        CNZ     PUTC0
        LDA     TZNUM
        DB      PUTC
PUTB2:  CALL    CRLF            ; (PUNDS ends here too)
        JMP     PUNOFF
PUTB3:  DB      QRET
PUTB4:  DB      QEND
        DB      ERROR,ETAPE

; Operations of the calculator that the tape adds

; QRND: mm to whole um: halves away from zero, 2 nm below a half counts as a half
XRND:   DB      Q1000,QMUL         ; um
        DB      QDUP,QABS,Q502,QADD     ; um |um|+0.502
        DB      QFLR,Q8DIG,QOVR,QSUB    ; um |whole| room
        DB      QJN
        DB      PUTB4-$
        DB      QSWP,QSIG,QRET          ; whole
; QVK: V = K in whole um; A = K, since the wire goes there (by no fillet, for all that is known here)
XVK:    DB      Q0,SSG     ; -
        DB      LKX,QDUP,SAX,QRND,SVX   ; -
        DB      LKY,QDUP,SAY,QRND,SVY,QRET ; -

; QUAD - quadrant of the vector a, each with its first axis (counter-clockwise)
; Out: C = its digit   Clobbers A, HL
QUAD:   LXI     H,MA
        CALL    FSGN
        MOV     C,A
        ADD     A
        ADD     C
        MOV     C,A             ; 3 * sign of x
        MVI     L,(MA+5)&255    ; (a0 begins a page)
        CALL    FSGN
        ADD     C
        ADI     4
        LXI     H,QUADS
        CALL    ADDA
        MOV     C,M
        RET

; by the signs of x and y: -- -0 -+ 0- 00 0+ +- +0 ++
QUADS:  DB      "332412411"

; SETZG - B, C = letter and digit of Z; the count goes along Y when t0 > 0, else along X
; Out: CY = X   Clobbers A, HL
SETZG:  MOV     H,C
        MOV     L,B
        SHLD    TZLET
        LXI     H,MT0
        CALL    FSGN            ; 1, or 0 or 0FFH
        DCR     A
        ADI     0FFH            ; CY: it was not 1
        SBB     A
        ADI     CLTY            ; CY again, when that was 0FFH
        STA     TGAX
        RET
