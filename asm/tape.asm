; tape.asm - moves in whole micrometres, as 3B blocks (tape-3b.md)
; Offers: ARC ARCL PUTB2 XRND XROOT XVK PUT2D
; Uses:   calc consts cut float geom io lexer start
; Room:   394 bytes, 478 with NODRIFT
;
; The wire stands at W, the move goes to V; everything is made from these rounded
; values.  An arc is looked at from its rounded centre, mirrored when it runs
; clockwise, so that there is one sense to think about; for the count along Y it is
; turned by a quarter, so that the count always runs along u:
;
;       (u,v) going round counter-clockwise from (r,0): u falls from r to -r in the
;       upper half plane, rises again in the lower.  F = r-u there, 3r+u here, is the
;       travel counted since (r,0): F = 2r - (u+r) * sign of v.  J = F(end) - F(start),
;       and 4r more when (r,0) was passed.  That is so when the difference is below -r,
;       or below r when the arc is more than half a turn: nothing between comes up.
;       r cancels out, and its square root is saved, when both ends lie in one half
;       plane; a start on the axis does not matter: it is r or -r itself.
;
; With the option NODRIFT W is where the controller really stands, and the centre of
; an arc is moved, so that the arc from there passes V (docs/drift.md).

TGAX    EQU CWORK+18    ; block: letter of the count direction
TZLET   EQU CWORK+19    ; L, N (for NR) or S (for SR)
TZNUM   EQU CWORK+20    ; its digit

;! TZLET == TGAX+1 -- PUTBLK takes two letters at once

; ARC - the wire goes along the circle C to K; byte-code that ADVANC (cut.asm, which must stand
;       in front of it) falls into
; In:  C, K, W; on the float stack: negative when it is more than half a turn   Out: W = V
; Clobbers all
ARC:    DB      QVK,ST3         ; -
        DB      LC0,QRND,SA0    ; -
        DB      LC1,QRND,SA1    ; -
        DB      LVX,SB0,LVY,SB1 ; -
        DB      QDIF,LC2,QSIG   ; u v           of the end; mirrored when clockwise
        DB      LWX,SB0,LWY,SB1 ; u v
        DB      QDIF,LC2,QSIG   ; u v u v       of the start
        DB      SA1,SA0,SB1,SB0 ; -             a = start, b = end
        IF      NODRIFT
        DB      QDIF,ST1,ST0    ; -             t0 t1 = chord d
        DB      LT0,LT1,QSS,ST4 ; -             t4 = |d|^2
        DB      QDOT,QJN        ; -             ends far apart: no doubt
        DB      ARC0-$
        DB      LT3,QJN         ; -             nearly round: any shift is too much
        DB      ARC1-$
        DB      QVEC,QHYP,QDBL ; 2r
        DB      LT4,QSUB,QJN    ; -             short; |d|^2 <= 2r, within 1/4 um:
        DB      ARC0-$
ARCL:   DB      QEND            ;               a line (ADVANC comes here too)
        JMP     MOVE
; the centre goes along the chord to where both ends are equally far from it
ARC0:   DB      LA0,LT0,QMUL,LA1,LT1,QMUL,QADD ; a*d
        DB      LT4,QDIV,QHALF,QADD,ST2 ; -     t2 = shift / d
        DB      LA0,LT2,LT0,QMUL,Q502,QADD,QFLR,QSUB,SA0 ; -
        DB      LA1,LT2,LT1,QMUL,Q502,QADD,QFLR,QSUB,SA1 ; -
        DB      LA0,LT0,QADD,SB0,LA1,LT1,QADD,SB1 ; -
        ELSE
        DB      QHALF,QCRS,QSUB ; -
        DB      QJN
        DB      ARC1-$
        DB      LT3,QJN         ; -
        DB      ARC1-$
        DB      QDOT,QJN        ; -             far apart: no doubt
        DB      ARC1-$
ARCL:   DB      QJMP            ;               short, and the sweep is not positive:
        DB      MOVE0-$         ; a line (ADVANC comes here too)
        ENDIF
ARC1:   DB      LA0,QABS,SBX,LA1,QABS,SBY ; -
        IF      NODRIFT
        DB      LBX,LBY,QMAX,QJZ ; -            the start is the centre: no arc
        DB      ARCL-$
        ENDIF
        DB      LB0,QABS,LB1,QABS,QSUB,ST0 ; -
        DB      QEND
        CALL    QUAD
        LDA     MC2+1           ; sign
        ORA     A
        MVI     B,CLTN
        JP      ARC3
        MVI     A,2*CZERO+5     ; clockwise quadrants are mirrored ones
        SUB     C
        MOV     C,A
        MVI     B,CLTS
ARC3:   CALL    SETZG
        JC      ARC4
        DB      CALC            ; count along Y: turned by a quarter
        DB      LA1,LA0,QNEG,SA1,SA0 ; -
        DB      LB1,LB0,QNEG,SB1,SB0 ; -
        DB      QEND
ARC4:   DB      CALC,LT3,QJN    ; -             an arc of up to half a turn ...
        DB      ARC5-$
        DB      LA1,LB1,QSIG,QJN ; -            ... in one half plane needs no r
        DB      ARC5-$
        DB      LA0,LB0,QSUB,LB1,QSIG ; d       = F(end)-F(start)
        DB      QDUP,QNEG,QJN   ; d             (below 0 when (r,0) was passed)
        DB      ARC7-$
        DB      QDRP            ; -
ARC5:
        IF      NODRIFT
        DB      Q1,QROOT,ST5    ; -             t5 = where the controller turns
        ELSE
        DB      QVEC,QSS        ; n             t5 = r: the root cut off ...
        DB      QDUP,QSQRT,QFLR,ST5 ; n
        DB      LT5,QSQ,QSUB    ; n-r^2         ... n > r^2+r: nearer to r+1
        DB      LT5,QSUB,QHALF,QSUB ; n-r^2-r-1/2
        DB      QJN
        DB      ARC6-$
        DB      LT5,Q1,QADD,ST5 ; -
        ENDIF
ARC6:   DB      LA0,LT5,QADD,LA1,QSIG ; 2r-F(start)
        DB      LB0,LT5,QADD,LB1,QSIG,QSUB ; d  = F(end)-F(start)
        DB      QDUP,LT5,LT3,QSIG,QADD ; d d+r  long: d-r; below 0 when (r,0) was passed
        DB      LT5,QDBL,QSWP,QSIG,QSUB ; d-2r     then d+2r
        DB      LT5,QDBL,QADD   ; J
ARC7:   DB      QABS,QDUP,SBJ,QJZ ; -
        DB      MOVE0-$         ; counted as nothing: a line
        IF      NODRIFT
; V = where the controller will stand: the step that ends the block goes from w+1 to w
        DB      LB0,LB1,QSIG,ST1 ; -            t1 = w
        DB      LT1,Q1,QADD,QROOT ; |v|
        DB      QHALF,LT1,QSIG,QADD,QHALF,QSUB ; |v|    less 1 when w < 0
        DB      LB1,QSIG,LB1,QSUB ; dv          v less that of b
        DB      LT0,QNEG,QJN    ; dv            back into the drawing's axes
        DB      ARC8-$
        DB      LC2,QSIG,LVY,QADD,SVY ; -
        DB      QJMP
        DB      ARC9-$
ARC8:   DB      LVX,QSWP,QSUB,SVX ; -
ARC9:
        ENDIF
        DB      QJMP
        DB      PUTB0-$

; MOVE - a straight move of the wire
; In:  W, V   Out: W = V   Clobbers all.  Byte-code jumps to MOVE0
MOVE:
        IF      NODRIFT
        DB      CALC
        ENDIF
MOVE0:  DB      LVX,LWX,QSUB,QDUP,SA0,QABS,SBX ; -
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
PUTBLK: DB      CALC
PUTB0:  DB      LVX,SWX,LVY,SWY ; -
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
XRND:   DB      CALC,Q1000,QMUL         ; um
        DB      QDUP,QABS,Q502,QADD     ; um |um|+0.502
        DB      QFLR,Q8DIG,QOVR,QSUB    ; um |whole| room
        DB      QJN
        DB      PUTB4-$
        DB      QSWP,QSIG,QRET          ; whole
        IF      NODRIFT
; QROOT: w -> least whole number whose square reaches n-w^2, n = a0^2+a1^2
; (exact for n < 2^32: the root of k^2+1 is still more than k when it is rounded)
XROOT:  DB      CALC,QSQ,QVEC,QSS,QSUB ; w^2-n
        DB      QABS,QSQRT,QNEG,QFLR,QNEG,QRET ; root
        ENDIF
; QVK: V = K in whole um; A = K, since the wire goes there (by no fillet, for all that is known here)
XVK:    DB      CALC,Q0,SSG     ; -
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

; PUT2D - two decimal digits to the paper
; In:  A = them   Clobbers A
PUT2D:  PUSH    PSW
        RRC
        RRC
        RRC
        RRC
        CALL    PUT1D
        POP     PSW
PUT1D:  ANI     0FH
        ORI     CZERO
        DB      PUTC
        RET
