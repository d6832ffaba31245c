; tape.asm - moves in whole micrometres, as 3B blocks (tape-3b.md)
; Offers: RUNCEL RUNLEN REPOS STOP PUNDS ENTER HOME MOVE PUTBLK ARCZ
; Uses:   [more] [punch] calc consts float geom io lexer round start
; Room:   274 bytes
;
; The wire stands at W, the move goes to V; everything is made from these rounded
; values; ARC (arc_3b.asm, arc_nodrift.asm) does the arcs.

TGAX    EQU CWORK+18    ; block: letter of the count direction
TZLET   EQU CWORK+19    ; L, N (for NR) or S (for SR)
TZNUM   EQU CWORK+20    ; its digit

;! TZLET == TGAX+1 -- PUTBLK takes two letters at once

RUNCEL  EQU MNEXT-4     ; what a run begins with cleared: four cells for drive.asm, N (which is nothing then), tolerance,
RUNLEN  EQU BLKNO+2-RUNCEL ; H, W, RMOVED, BLKNO

;! MC2+20 <= RUNCEL and BLKNO+2 <= MFIRST and RUNCEL+4 == MNEXT -- RUNINI clears no other cells

; REPOS - FROM: the first one is silent, another one a move between two stops
; In:  on the float stack the new start hole, and the same in whole um
; Out: H, W = H; ERR 10 when the move is too long, before anything is done   Clobbers all
REPOS:  LXI     H,RMOVED
        MOV     A,M
        ORA     A
        JNZ     REPOS1
        INR     M
        DB      CALC,SWY,SWX,SHY,SHX ; -
REPOS2: DB      QRET            ; (for PUTBLK too)
REPOS1: DB      CALC,LWY,QSUB,QABS,QFITS,QDRP ; x y x'
        DB      LWX,QSUB,QABS,QFITS,QDRP ; x y
        DB      SHY,SHX,QEND    ; -
        CALL    STOP
        CALL    HOME
; (fall into STOP)

; STOP - punches D: the controller stops   Clobbers A, B
STOP:   MVI     B,1
; (fall into PUNDS)

; PUNDS - punches B times D, and the end of the line
; In:  B   Clobbers A, B
PUNDS:  CALL    PUNON
PUNDS1: MVI     A,CLTD
        DB      PUTC
        DCR     B
        JNZ     PUNDS1
        JMP     PUTB2

; ENTER - the wire goes to the route's beginning
; In:  K, W   Out: G = A = K, W = V   Clobbers all
ENTER:  DB      CALC,LKX,SGX,LKY,SGY,QJMP ; -
        DB      MOVE1-$

; HOME - straight to the start hole
; In:  H, W   Out: A = K = H, W = V   Clobbers all
HOME:   DB      CALC,LHX,LHY,QTOK,QEND ; -
; (fall into MOVE)

; MOVE - a straight move of the wire
; In:  K, W   Out: A = K, W = V   Clobbers all
MOVE:   DB      CALC
MOVE1:  DB      QVK             ; -
        DB      LVX,LWX,QSUB,QDUP,SA0,QABS,SBX ; -
        DB      LVY,LWY,QSUB,QDUP,SA1,QABS,SBY ; -
        DB      LBX,LBY,QMAX,SBJ ; -
        DB      LBX,LBY,QSUB    ; x-y           x = y: along Y in quadrants 1 and 3
        DB      QHALF,LA0,QSIG,LA1,QSIG,QSUB,ST0,QEND ; -
        CALL    QUAD
        MVI     B,CLTL
        CALL    SETZG
; (fall into PUTBLK)

; PUTBLK - lists and punches a block; J = 0 is none
; In:  BX BY BJ, TGAX TZLET TZNUM, V   Out: W = V; ERR 10 when too long   Clobbers all
PUTBLK: DB      CALC,LBJ,QFITS,QJZ ; -          (BX and BY of a line are no longer; ARCZ has seen to those of an arc)
        DB      REPOS2-$        ; none
        DB      LVX,SWX,LVY,SWY,QEND ; -
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

; QUAD - quadrant of the vector a, each with its first axis (counter-clockwise)
; Out: C = its digit   Clobbers A, HL
QUAD:   LXI     H,MA
        CALL    FSGN
        MOV     C,A             ; C = sign of x
        MVI     L,(MA+5)&255    ; (a0 begins a page)
        CALL    FSGN
        JNZ     QUAD1
        MOV     A,C             ; on the X axis that tells the half
QUAD1:  CMP     C               ; A = 1 for quadrants 1 and 2, -1 for 3 and 4
        MOV     C,A
        MVI     A,CZERO+3
        JNZ     QUAD2
        DCR     A               ; 1 and 3: the sign of x is the same
QUAD2:  SUB     C
        MOV     C,A
        RET

; ARCZ - what an arc's block says besides J, for ARC
; In:  a, b = start and end as seen from the centre, mirrored when it runs clockwise; C2
; Out: BX BY, TGAX TZLET TZNUM, t0; a, b as SETZG   Clobbers all
ARCZ:   DB      CALC,LA0,QABS,QFITS,SBX ; -
        DB      LA1,QABS,QFITS,SBY ; -
        DB      LB1,QABS,LB0,QABS,QSUB,ST0,QEND ; -
        CALL    QUAD
        LDA     MC2+1           ; sign
        ORA     A
        MVI     B,CLTN
        JP      SETZG
        MVI     A,2*CZERO+5     ; clockwise quadrants are mirrored ones
        SUB     C
        MOV     C,A
        MVI     B,CLTS
; (fall into SETZG)

; SETZG - B, C = letter and digit of Z; the count goes along Y when t0 is negative, else along X
; Out: for the count along Y a and b are turned by a quarter, clockwise   Clobbers all
SETZG:  MOV     H,C
        MOV     L,B
        SHLD    TZLET
        LDA     MT0+1           ; bit 7: sign
        RLC
        CMC
        SBB     A
        ADI     CLTY            ; CY again, when that was 0FFH
        STA     TGAX
        RC
        DB      CALC,LA1,LA0,QNEG,QSA ; -
        DB      LB1,LB0,QNEG,QSB+QRET ; -
