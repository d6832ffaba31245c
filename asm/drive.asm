; drive.asm - the board follows the blocks itself, and steps two motors (drive.md)
; Offers: PUNOFF SDRIV BDOFF BDREST
; Uses:   calc consts decimal float io io_port io_punch monitor reset start tape value
; Room:   697 bytes
;
; A step goes along one of two records, one for each axis:
;
;       N       steps to go on this axis, negative, high byte first: counted up to 0
;       R       what a step adds to F, low byte first
;       U       the port with this axis's pulse up
;
; so that the low bytes of N and R lie side by side.  Record 1 is that of the block's x: on an arc it
; steps X and R = 2x+1, on a line Y and R = 2x (a line steps X where y is taken off F).  The record
; that leads inside, whose step F >= 0 wants, has the sign of R changed: 1-2p on an arc, of the coordinate p
; that shrinks; each of an arc's steps adds 2 to its own R.  So R comes from -1 to 1 where p comes
; to 0, which is a carry out of its highest byte: there the next quadrant begins, and the records exchange
; their roles.  The twofold F has the sign of tape-3b.md's.  A block is over when the N of the count's
; axis has come to 0; the other one's never does.

DRIVE   EQU 14H         ; the machine's port, out:
DYSTEP  EQU 04H         ; Y step
DSTEPS  EQU 05H         ; both step bits
DOFF    EQU 80H         ; cutting; in DSTATE: not cutting
DSTOPB  EQU 02H         ; in: limit or emergency stop (bit 0: feed clock)
DASK    EQU 02H         ; in DSTATE, counted: a key comes first,
DHALF   EQU 01H         ; so it does, and a block was stopped

DN1     EQU HELD        ; the cells lie in FIT's, which holds nothing back here: record 1,
DR1     EQU DN1+4
DU1     EQU DN1+8
DN2     EQU DN1+9       ; record 2
DR2     EQU DN1+13
DU2     EQU DN1+17
DROLE   EQU DN1+18      ; bit 7: F >= 0 steps record 2
DBASE   EQU DN1+19      ; the port without a pulse
DINC    EQU DN1+20      ; what a step adds to its own R: 2 on an arc, else 0
DTURN   EQU DN1+21      ; low two bits: what is added to the quadrant: 0 line, 1 counter-clockwise, 3 clockwise
DQUAD   EQU DN1+22      ; low two bits: the quadrant that the motion points into
DMODE   EQU DN1+23      ; 0FFH: RUN drives, 0: it does not
DFDEV   EQU DN1+24      ; F of a block that was stopped
DCOUNT  EQU DN1+28      ; -> the count's N
DSTATE  EQU RUNCEL+RUNLEN-1 ; DOFF, DASK, DHALF; RUN clears it

;! DN1/100H == (DCOUNT+1)/100H -- the loop changes L alone
;! DU2-DU1 == 9 and DR2-DR1 == 9 and DN2-DN1 == 9 and DR1-DN1 == 4 and DU1-DR1 == 4 -- DLOOP walks along a record
;! DQUAD == DTURN+1 and TZNUM == TZLET+1 -- FOLLOW and DIRS take two cells at once
;! DSTATE == BLKNO+2 and DSTATE < MFIRST -- it lies in a free cell of RUNINI's
;! DCOUNT+2 <= CLOSED -- what FIT would hold back ends there

; DLOOP - steps, until there is something else to see to
; In:  B C D E = F, H = DN1/256
; Out: Z: the low byte of an N has run out, HL -> it; CY: the clock has not fallen behind the step; neither: it is low,
;      or stop   Clobbers A, HL
; Cycles: a step 293, with a carry 20 to 60 more, with a new quadrant 700
DLOOP:  IN      DRIVE
        ANI     3
        DCR     A
        RNZ
        MVI     L,DR1&255
        LDA     DROLE
        XRA     B
        JP      DLOO1
        MVI     L,DR2&255
DLOO1:  MOV     A,E
        ADD     M
        MOV     E,A
        INR     L
        MOV     A,D
        ADC     M
        MOV     D,A
        INR     L
        MOV     A,C
        ADC     M
        MOV     C,A
        INR     L
        MOV     A,B
        ADC     M
        MOV     B,A
        INR     L
        MOV     A,M
        OUT     DRIVE
        MOV     A,L
        SUI     4
        MOV     L,A
        LDA     DINC
        ADD     M
        MOV     M,A
        CC      DCAR
        DCR     L
        INR     M
        IN      DRIVE
        RAR
        LDA     DBASE
        OUT     DRIVE
        RC
        JNZ     DLOOP
        RET

; DCAR - carries into the higher bytes of R; out of them: the next quadrant
; In:  HL -> lowest byte   Clobbers A
DCAR:   PUSH    H
        MVI     A,3
DCAR1:  INR     L
        INR     M
        JNZ     DCAR2
        DCR     A
        JNZ     DCAR1
        PUSH    B
        CALL    DIRS
        POP     B
DCAR2:  POP     H
        RET

; DIRS - directions and roles of the next quadrant; the record that leads inside changes the sign of R
; In:  DTURN, DQUAD, DSTATE   Out: ERR 10: an arc begins where its coordinate cannot shrink   Clobbers A, B, C, HL
DIRS:   LHLD    DTURN           ; and DQUAD
        MOV     A,L
        ADD     H
        STA     DQUAD
        MOV     C,A
        DCR     A
        ANI     2
        RLC
        RLC
        MOV     B,A             ; Y direction
        MOV     A,C
        ANI     2               ; X direction
        ORA     B
        MOV     B,A
        LDA     DSTATE
        XRI     DOFF
        ORA     B
        STA     DBASE
        MOV     B,A
        MOV     A,L
        RRC
        MOV     L,A
        SBB     A
        ANI     DSTEPS
        XRI     DYSTEP          ; X on an arc, Y on a line
        ORA     B
        STA     DU1
        XRI     DSTEPS
        STA     DU2
        MOV     A,L
        XRA     C
        RRC
        STA     DROLE
        LXI     H,DR1
        JNC     DIRS2
        MVI     L,DR2&255
DIRS2:  LDA     DINC
        ORA     A
        MVI     B,4
DIRS3:  SBB     M
        MOV     M,A
        INR     L
        MVI     A,0
        DCR     B
        JNZ     DIRS3
        RC
        LDA     DINC
        ORA     A
        RZ                      ; a line along an axis
        DB      ERROR,ETAPE

; PUNOFF - punch off, the block is complete: the place for a break; after DRIVE 1 a running program's is followed
; In:  B = 0: it was D or DD, BX BY BJ, TGAX TZLET TZNUM   Clobbers all
PUNOFF: CALL    PAPON
        LHLD    NXTP+1          ; and CHKF
        DCR     H
        RP                      ; after an error
        LDA     DMODE
        ANA     L
        RZ                      ; not asked for, or no program
        MOV     A,B
        ORA     A
        JZ      DRVSTP
; (fall into FOLLOW)

; FOLLOW - follows a block
; In:  BX BY BJ, TGAX TZLET TZNUM: their lowest bits   Out: ERR 10 when it was stopped   Clobbers all
FOLLOW: CALL    DREADY
        LHLD    TZLET           ; and TZNUM
        MOV     A,L
        SUI     CLTL            ; L 0, N 2, S 7
        RAR
        MOV     L,A
        SHLD    DTURN           ; and DQUAD
        ANI     1
        ADD     A
        STA     DINC
        LXI     H,MBX
        LXI     D,DR1
        CALL    DNUM
        LXI     H,MBX+5
        LXI     D,DR2
        CALL    DNUM
        LXI     H,MBX+10
        MOV     A,M
        ORA     A
        RZ                      ; J = 0 is no block
        CALL    FWHOLE
        LDA     DTURN
        LXI     H,TGAX
        XRA     M
        RAR
        LXI     H,DN1
        JC      FOLL1
        MVI     L,DN2&255
FOLL1:  SHLD    DCOUNT
        STA     DN1             ; (A is positive: the other N will never run out)
        STA     DN2
        CALL    DNEG
        MOV     M,B
        INX     H
        MOV     M,C
        INX     H
        MOV     M,D
        INX     H
        MOV     M,E
        CALL    DIRS
        MOV     C,B             ; (DIRS leaves B = 0)
        MOV     D,B
        MOV     E,B
; (fall into DRUN)

; DRUN - steps to the block's end
; In:  B C D E = F, the records   Out: ERR 10 when it is stopped: its place is typed, J less the steps to go, and
;      DHALF, DFDEV   Clobbers all
DRUN:   LDA     DBASE
        OUT     DRIVE
DRUN1:  MVI     H,DN1/256
        CALL    DLOOP
        JNZ     DRUN3
        MVI     A,3
DRUN2:  DCR     L
        INR     M
        JNZ     DRUN3
        DCR     A
        JNZ     DRUN2
        RET
DRUN3:  PUSH    PSW             ; CY: the clock has not fallen yet
        CALL    POLL
        CPI     CCTLC
        JZ      DRUN4
        IN      DRIVE
        ANI     DSTOPB
        JNZ     DRUN4
        POP     PSW
        JNC     DRUN1
        IN      DRIVE
        RAR
        JMP     DRUN3
DRUN4:  MVI     M,0             ; no key is typed ahead
        XRA     A
        OUT     DRIVE
        XCHG
        SHLD    DFDEV
        MOV     H,B
        MOV     L,C
        SHLD    DFDEV+2
        LXI     H,DSTATE
        INR     M               ; DHALF
        CALL    CRLF
        MVI     A,CMINUS
        DB      PUTC
        LHLD    DCOUNT
        CALL    FLOAD           ; (the highest bit is 1 anyway)
        CALL    DNEG
        XCHG
        MOV     D,B
        MOV     E,C
        MVI     C,0
        CALL    DECOU1
        DB      ERROR,ETAPE

; DNEG - changes the sign
; In:  B C D E   Out: B C D E   Clobbers A
DNEG:   XRA     A
        SUB     E
        MOV     E,A
        MVI     A,0
        SBB     D
        MOV     D,A
        MVI     A,0
        SBB     C
        MOV     C,A
        MVI     A,0
        SBB     B
        MOV     B,A
        RET

; DNUM - R of a coordinate: doubled, and 1 on an arc
; In:  HL -> float, DE -> R, DINC   Clobbers all
DNUM:   PUSH    D
        MVI     A,9FH
        CALL    FALIGN
        POP     H
        LDA     DINC
        RRC
        ORA     E
        MOV     M,A
        INX     H
        MOV     M,D
        INX     H
        MOV     M,C
        INX     H
        MOV     M,B
        RET

; DREADY - waits for the key that comes first, if one does
; Out: DSTATE = DOFF or 0; ERR 10   Clobbers A, HL
DREADY: LDA     DSTATE
        ADD     A
        JZ      DREA2
        CALL    BREAK
        MVI     M,0             ; none that is typed ahead
DREA1:  CALL    BREAK
        ORA     A
        JZ      DREA1
        MVI     M,0
DREA2:  LXI     H,DSTATE
        MOV     A,M
        ANI     DOFF
        MOV     M,A
        RET

; SDRIV - command: DRIVE follows the reader's tape; DRIVE 1, DRIVE 0: RUN drives, or not
SDRIV:  DB      PEEK
        JNZ     SDRI9
        DB      CHKEND
        LXI     H,DSTATE
        MOV     A,M
        RAR                     ; (CHKEND leaves CY clear)
        JNC     SDRI0
        CALL    DREADY          ; the block that was stopped
        LHLD    DFDEV
        XCHG
        LHLD    DFDEV+2
        MOV     B,H
        MOV     C,L
        CALL    DRUN
        INR     A               ; (not 0)
SDRI0:  ANI     (DOFF/2)-1
        JNZ     SDRI1           ; broken off at a stop
        MOV     M,A             ; a new tape
SDRI1:  CALL    DGET
        JC      SDRI1
        CPI     CLTD-CZERO
        JZ      SDRI6
        LXI     H,MBX
SDRI2:  CPI     CLTB-CZERO
        JNZ     ERTAPE
        PUSH    H               ; -> where the number goes
        DB      CALC,Q0,QEND    ; x
        LXI     B,10
        CALL    DWANT
SDRI3:  MOV     L,A
        MVI     H,0
        LXI     D,MT0
        CALL    FITOF
        DB      CALC,Q10,QMUL,LT0,QADD ; 10x+digit
        DB      QDUP,Q8DIG,QSWP,QSUB,QE6N,QEND ; x
        CALL    DGET
        CPI     10
        JC      SDRI3
        POP     D
        PUSH    PSW
        CALL    CALPOP
        INX     H
        POP     B               ; B = behind the digits
        MOV     A,L
        CPI     (MBX+15)&255
        MOV     A,B
        JNZ     SDRI2
        CPI     CLTG-CZERO
        JNZ     ERTAPE
        LXI     B,(CLTY-1-CZERO)*256+2
        CALL    DWANT
        STA     TGAX
        CALL    DGET
        STA     TZLET
        CPI     CLTL-CZERO
        JZ      SDRI5
        CPI     CLTN-CZERO
        JZ      SDRI4
        CPI     CLTS-CZERO
        JNZ     ERTAPE
SDRI4:  LXI     B,(CLTR-CZERO)*256+1
        CALL    DWANT
SDRI5:  LXI     B,1*256+4
        CALL    DWANT
        INR     A
        STA     TZNUM
        CALL    DGET
        JNC     ERTAPE
        CALL    FOLLOW
        JMP     SDRI1
SDRI6:  CALL    DGET
        JC      SDRI7
        CPI     CLTD-CZERO
        JNZ     ERTAPE
        CALL    CRLF
        CALL    BDOFF
        STA     DSTATE
        RET
SDRI7:  CALL    DRVSTP
        CALL    DREADY
        JMP     SDRI1
SDRI9:  CALL    LNEND
        LXI     H,-2
        DAD     D
        JC      ERRNG
        XRA     A
        STA     DSTATE          ; a block that was stopped is forgotten
        SUB     E
        STA     DMODE
        RET

; DWANT - a character that must be one of a few
; In:  B = the first, less '0', C = how many   Out: A = its number among them; ERR 10   Clobbers HL
DWANT:  CALL    DGET
        SUB     B
        CMP     C
        RC
        DB      ERROR,ETAPE

; DGET - a character of the tape, which is typed
; Out: A = it, less '0'; CY: it comes before '0': a line's end, a blank; ERR 10   Clobbers HL
DGET:   CALL    BDREAD
        ANI     7FH
        PUSH    PSW
        CZ      BREAK           ; (not within a line that is there)
        POP     PSW
        JZ      DGET
        DB      PUTC
        SUI     CZERO
        RET

; DRVSTP - D: off; a key comes before the next block, which is a travel or none again
; Clobbers A, HL
DRVSTP: LXI     H,DSTATE
        MOV     A,M
        ADI     DOFF+DASK       ; (60 stops without a block between them would carry)
        MOV     M,A
; (fall into BDOFF)

; BDOFF - after an error and at a program tape's end: no more lines from the reader; the machine is off
; Out: A = 0
BDOFF:  XRA     A
        STA     LOADF
        OUT     DRIVE
        RET

; BDREST - what is readied at reset besides the serial ports
; Clobbers A
BDREST: XRA     A
        STA     DMODE
        OUT     DRIVE
        JMP     RESET
