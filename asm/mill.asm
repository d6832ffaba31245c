; mill.asm - the statements of milling: F, Z, M, G, HOLE (milling.md)
; Offers: SFREES SFEED SHGHT SPREP SMISC SHOLE
; Uses:   calc consts cut float grid io_send iso monitor parser start value
; Room:   320 bytes

LASTW   EQU 99          ; greatest number of M, G and T

; SFREES - FREE, which has to be read in front of F, as a statement; in a program it is none
; Out: ERR 01 in a line with a number
SFREES: LDA     TOKS
        DCR     A               ; TFLT?
        JZ      ERSYN
        JMP     SFREE

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
        MVI     A,10
        JMP     COPY

; FARG - takes a feed, or another number of 0.001 to 99999999
; Out: the number on the float stack (not in check mode); ERR 04, ERR 05   Clobbers all
FARG:   CALL    EVNUM
        CALL    CHKRET
        DB      CALC,LA0,QMU,QSUB ; a
        DB      Q8DIG,LA0,QSUB,QMUL,QSQRT,QDRP ; - (the root refuses what is negative)
        DB      LA0,QRET        ; x

; ZARG - takes a height
; Out: in whole um on the float stack (not in check mode); ERR 04, ERR 10   Clobbers all
ZARG:   CALL    EVNUM
        CALL    CHKRET
        DB      CALC,LA0,QRND,QRET ; z

; SHGHT - statement: Z cutting height; Z cutting height, travel height
SHGHT:  LXI     D,RTRAVZ
        CALL    OOVR            ; t             as it was
        LDA     RSETZ
        ORA     A
        JNZ     SHGHT1
        DB      CALC,QDRP,Q1000,Q10,QMUL,QHALF,QMUL,QEND ; t   5 mm at first
SHGHT1: CALL    ZARG            ; t z
        DB      PEEK
        JZ      SHGHT2
        DB      EXPECT,CCOMMA
        CALL    ZARG            ; t z t1
        DB      CALC,QSWP,QEND  ; t t1 z
SHGHT2: DB      CHKEND
        DB      CALC,ST0,ST1    ; ...
        DB      LT1,LT0,QSUB,QSQRT,QDRP,QEND ; ... (the root refuses what is negative)
        CALL    NOROUT
        LXI     H,RCUTZ
        CALL    PAIR
        MVI     M,1             ; RSETZ
        RET

; NOROUT - demands that no route is open
; Out: ERR 06   Clobbers A
NOROUT: LDA     RITEMS
        ORA     A
        RZ
        DB      ERROR,EGEOM

; WHOLE - takes the number of an M, G or T
; Out: the number on the float stack, L = it (in check mode any); ERR 04, ERR 05   Clobbers all
WHOLE:  CALL    EVINT
        LXI     D,-LASTW-1
        XCHG
        DAD     D
        JC      ERRNG
        PUSH    D
        DB      CALC,LB0,QEND   ; n             (EVINT leaves it there)
        POP     H
        RET

; SPREP - statement: G n; G n, number.  SMISC - statement: M n; M n, number
SPREP:  LXI     D,GTAB
        JMP     WORD1
SMISC:  LXI     D,MTAB
WORD1:  PUSH    D
        CALL    WHOLE           ; n
        POP     D
WORD2:  LDAX    D
        CMP     L
        JZ      ERRNG           ; the program's own
        INX     D
        ORA     A
        JP      WORD2
        MOV     B,A             ; B = letter, with bit 7
        LDAX    D               ; C = the other number's
        CPI     CLTS
        JNZ     WORD3
        MOV     A,L
        SUI     6
        MVI     A,CLTS
        JNZ     WORD3
        INR     A               ; M6: T
WORD3:  MOV     C,A
        PUSH    B
        DB      PEEK
        JZ      WORD4
        DB      EXPECT,CCOMMA
        LXI     H,WORD5
        PUSH    H
        MOV     A,C
        CPI     CLTT
        JZ      WHOLE           ; n d
        JMP     FARG            ; n d
WORD4:  POP     B
        MVI     C,0             ; there is none
        PUSH    B
WORD5:  DB      CHKEND
        CALL    NOROUT
        CALL    BLOCK
        POP     B
        MOV     A,B
        PUSH    B
        CPI     CLTG+80H
        LXI     H,FSTK
        CZ      PUTNUM          ; G goes first
        MOV     A,C
        ORA     A
        LXI     H,FSTK+5
        CNZ     PUTNUM
        POP     B
        MOV     A,B
        CPI     CLTM+80H
        LXI     H,FSTK
        CZ      PUTNUM          ; M last
        JMP     BLKOFF

; Numbers that are the program's own, then the letter with bit 7 set, then that of what may follow
GTAB:   DB      0,1,2,3,17,18,19,20,21,40,41,42,90,91,93,95,CLTG+80H,CLTP
MTAB:   DB      2,30,CLTM+80H,CLTS

; SHOLE - statement: HOLE point, point ...
SHOLE:  CALL    EVPNT
        CALL    HOLE
        CALL    MORE
        JMP     SHOLE

; HOLE - drills one
; In:  a point as value   Out: H = W = it; ERR 06, ERR 03   Clobbers all
HOLE:   CALL    CHKRET
        CALL    NOROUT
        LDA     RSETZ
        ORA     A
        JZ      ERUNS
        CALL    SCALED
        DB      CALC,LA0,SHX,LA1,SHY,QEND ; -
        CALL    REPOS
        CALL    DOWN
        JMP     UP
