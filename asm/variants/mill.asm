; mill.asm - the statements of milling: F, Z, M, G, HOLE (milling.md)
; Offers: SFREES SFEED SHGHT SPREP SMISC SHOLE
; Uses:   [post] calc consts corner cut float geom monitor parser round route start value
; Room:   290 bytes

LASTW   EQU 99          ; greatest number of M, G and T

; SFREES - FREE, which has to be read in front of F, as a statement; in a program it is none
; Out: ERR 01 in a line with a number   Clobbers all
SFREES: LDA     TOKS
        DCR     A               ; TFLT?
        JNZ     SFREE
        DB      ERROR,ESYN

; SFEED - statement: F feed; F feed, feed downwards
SFEED:  CALL    FARG
        DB      CALC,QDUP,QEND  ; d d           (for both)
        DB      PEEK
        JZ      SFEED1
        DB      EXPECT,CCOMMA
        CALL    FARG            ; d d d1
SFEED1: DB      CHKEND
        DB      CALC,ST1,ST0,QEND ; ...
        LXI     H,RFEED
; (fall into PAIR)

; PAIR - stores t0 and t1
; In:  HL -> to   Clobbers A, DE, HL
PAIR:   LXI     D,MT0
        JMP     CPYPL

; FARG - takes a feed, or another number of 0.001 to 99999999
; Out: the number on the float stack (not in check mode); ERR 04, ERR 05   Clobbers all
FARG:   CALL    EVNUM
        RNZ
        DB      CALC,LA0,QMU,QSUB ; a
        DB      Q10,QSQ,QSQ,QSQ,Q1,QSUB ; a 99999999
        DB      LA0,QSUB,QMUL,QSQRT,QDRP ; - (the root refuses what is negative)
        DB      LA0,QRET        ; x

; ZARG - takes a height
; Out: in whole um above 5 mm on the float stack (not in check mode); ERR 04, ERR 10   Clobbers all
ZARG:   CALL    EVNUM
        RNZ
        DB      CALC,LA0,QRND,Q10,QHALF,QMUL,QRND,QSUB+QRET ; z

; SHGHT - statement: Z cutting height; Z cutting height, travel height
SHGHT:  LXI     D,RTRAVZ
        CALL    OOVR            ; t             as it was
        CALL    ZARG            ; t z
        DB      PEEK
        JZ      SHGHT1
        DB      EXPECT,CCOMMA
        CALL    ZARG            ; t z t1
        DB      CALC,QSWP,QEND  ; t t1 z
SHGHT1: DB      CHKEND
        DB      CALC,ST0,ST1    ; ...
        DB      LT1,LT0,QSUB,QSQRT,QEND ; ... (the root refuses what is negative)
        CALL    NOROUT
        LXI     H,RCUTZ
        CALL    PAIR
        MVI     M,0FFH          ; RSETZ
        RET

; NOROUT - demands that no route is open
; Out: ERR 06   Clobbers A
NOROUT: LDA     RITEMS
        ORA     A
        RZ
        DB      ERROR,EGEOM

; WHOLE - takes the number of an M, G or T
; Out: Z, DE = the number, on the float stack, too (in check mode any); ERR 04, ERR 05   Clobbers all
WHOLE:  CALL    EVINT
        PUSH    H
        LXI     D,-LASTW-1
        DAD     D
        JC      ERRNG
        DB      CALC,LB0,QEND   ; n             (EVINT leaves it there)
        POP     D
        RET

; SPREP - statement: G n; G n, number.  SMISC - statement: M n; M n, number
; The CALL is followed by the letter with bit 7 set, that of what may follow, and limits: numbers from the first one
; up to the second (without it) are not the program's, nor those from the third up to the fourth ...  The CALL
; behind the last limit is above all numbers
SPREP:  CALL    WORD
        DB      CLTG+80H,CLTP
        DB      0,4,17,22,33,34,38,39,40,43,73,92,93,94,95,96
SMISC:  CALL    WORD
        DB      CLTM+80H,CLTS
        DB      2,3,30,31
WORD:   CALL    WHOLE           ; n
        POP     H
        MOV     B,M             ; B = letter, with bit 7
        INX     H
        MOV     C,M             ; C = the other number's
WORD1:  INR     D               ; D = limits up to n, and 1 (it was 0)
        INX     H
        MOV     A,E
        CMP     M
        JNC     WORD1
        MOV     A,D
        RAR
        JNC     ERRNG           ; not the program's
        MOV     A,E
        ADI     CLTS-6
        CMP     C
        JNZ     WORD2
        INR     C               ; M6: T (no G comes here with a P: it would be G3)
WORD2:  DB      PEEK
        JZ      WORD3
        PUSH    B
        DB      EXPECT,CCOMMA
        MOV     A,C
        CPI     CLTT
        CZ      WHOLE           ; n d           (leaves Z set)
        CNZ     FARG            ; n d
        DB      SKIP2           ; skips MOV and PUSH
WORD3:  MOV     C,A             ; (0, from PEEK) there is none
        PUSH    B
WORD4:  DB      CHKEND
        CALL    NOROUT
        CALL    BLOCK
        POP     B
        PUSH    B
        MOV     A,C
        CPI     CLTS
        LXI     H,FSTK+5
        CNC     PUTNUM          ; S and T stand in front of M
        POP     PSW             ; A = letter; C stays
        LXI     H,FSTK
        CALL    PUTNUM
        MOV     A,C
        CPI     CLTP
        CZ      PUTNUM          ; P behind G
        JMP     BLKOFF

;! PLCSIZ == 2*5 -- PAIR: a place is two floats, too
;! CLTT == CLTS+1 and CLTP == CLTS-3 -- M6 has a T; G3 is the program's own

; SHOLE - statement: HOLE point, point ...
SHOLE:  CALL    EVPNT
        CZ      HOLE
        CALL    MORE
        JMP     SHOLE

; HOLE - drills one
; In:  a point as value   Out: H = W = it; ERR 06, ERR 03, ERR 10   Clobbers all, the float stack too
HOLE:   CALL    NOROUT
        LDA     RSETZ
        LXI     H,RFEED
        ANA     M
        JZ      ERUNS           ; (before anything is done)
        CALL    SCALED
        DB      CALC,QVEC,LA0,QRND,LA1,QRND,QEND ; x y x' y'  ERR 10, before anything is done
        CALL    REPOS
        CALL    DOWN
        JMP     UP
