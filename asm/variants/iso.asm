; iso.asm - moves in whole micrometres, as blocks of ISO words (milling.md)
; Offers: RFEED RCUTZ RTRAVZ RSETZ RGNUM RUNCEL RUNLEN HOME UP DOWN REPOS ENTER MOVE GXY PUTNUM STOP
;         PUNDS BLOCK
; Uses:   [post] calc consts decimal float geom io lexer parser round start value
; Room:   323 bytes
;
; The tool stands at W in the plane and at the height WZ, the move goes to V (arcs: arc_iso.asm) or to
; the height VZ; all in whole um.  At the beginning of a tape W and WZ are a number that no place is, so
; that no move is left out.

SVZ     EQU SBX         ; height to go to, where an arc has I
LVZ     EQU LBX
MVZ     EQU MBX
SWZ     EQU SBJ         ; height of the tool
LWZ     EQU LBJ
MWZ     EQU MBX+10
MVX     EQU MO1
MWX     EQU MHX+10
NOWHER  EQU 0A8H        ; exponent of what no place is: 2^39 um and more
LASTNO  EQU 9999        ; the block behind which 1 comes

; Cells in the room that MWORK has left, and behind the registers
RFEED   EQU MWORK+25    ; feed in the plane; 0: none yet
RDOWN   EQU MWORK+30    ; feed downwards
RCUTZ   EQU MWORK+35    ; cutting height, in whole um above 5 mm: a run begins with 0
RTRAVZ  EQU MWORK+40    ; travel height, likewise
RSETZ   EQU MWORK+45    ; 0FFH = there has been a Z
RGNUM   EQU MWORK+46    ; the block's G, 0 to 3

RPUNF   EQU MREG+320    ; behind the registers, with room for a value: the last F that was punched; 0: none

RUNCEL  EQU RFEED       ; what a run begins with cleared: from here to BLKNO, since KEPT, nodes, a, b, C
RUNLEN  EQU BLKNO+2-RFEED ; and N are nothing then

;! RGNUM+1 <= KEPT and RPUNF+15 <= LINBUF and RUNLEN < 100H and RUNCEL+RUNLEN <= MFIRST -- RUNINI clears these cells
;! RDOWN == RFEED+5 and RTRAVZ == RCUTZ+5 and RSETZ == RCUTZ+10 -- SFEED and SHGHT store two at once
;! RFEED/100H == RDOWN/100H -- GWORDS is given the low byte alone
;! MVX == MREG+280 and MVZ == MVX+10 and MWZ == MVX+20 and MWX == MREG+185 -- the same registers; X Y I J lie together

; HOME - straight to the start hole, and up
; In:  H, W   Clobbers all
HOME:   CALL    TOHOLE
        CALL    MOVE
; (fall into UP)

; UP - to the travel height, when there has been a Z; a tape's first move begins here
; Clobbers all
UP:     CALL    TAPE0
        LXI     D,RTRAVZ
        XRA     A
        JMP     DOWN1

; DOWN - to the cutting height, when there has been a Z
; Clobbers all
DOWN:   LXI     D,RCUTZ
        MVI     A,1
DOWN1:  STA     RGNUM           ; (UP comes in here with A = 0)
        LDA     RSETZ
        ORA     A
        RZ
        CALL    OOVR            ; z             (above 5 mm)
        DB      CALC,Q10,QHALF,QMUL,QRND,QADD ; z
        DB      QDUP,SVZ,LWZ,QSUB,QJZ ; -
        DB      THERE-$
        DB      QEND
        CALL    GBLOCK
        DB      CALC,LVZ,SWZ,QEND ; -
        LXI     H,MVZ
        LXI     D,GLETZ
        LXI     B,(RDOWN&255)*256+1
        JMP     GWORDS

; TOHOLE - the start hole is where the tool shall go
; Clobbers all
TOHOLE: DB      CALC,LHX,LHY,QTOK ; -
THERE:  DB      QRET            ; (for DOWN and MOVEG: nothing to do)

; REPOS - FROM: at the travel height to the start hole
; In:  on the float stack the new start hole, and the same in whole um   Out: H, W = H   Clobbers all
REPOS:  DB      CALC,QDRP,QDRP,SHY,SHX,QEND ; -
; OVER - the same where the start hole is known
; In:  H, W   Clobbers all
OVER:   CALL    UP
        CALL    TOHOLE
        XRA     A
        JMP     MOVEG

; ENTER - the tool goes to the start hole, down, and to the route's beginning
; In:  H, K, W   Out: G = A = K, W = V; ERR 03 without a feed   Clobbers all
ENTER:  LDA     RFEED
        ORA     A
        JZ      ERUNS           ; (before anything is done; no block cuts but in a route that was entered, and in a hole)
        DB      CALC,LKX,SGX,LKY,SGY,QEND ; -
        CALL    OVER
        CALL    DOWN
        DB      CALC,LGX,LGY,QTOK,QEND ; -
; (fall into MOVE)

; MOVE - a straight cut
; In:  K, W   Out: A = K, W = V   Clobbers all
MOVE:   MVI     A,1
; MOVEG - the same with A = number of G   Clobbers all
MOVEG:  STA     RGNUM
        DB      CALC,QVK        ; -
        DB      LVX,LWX,LVY,LWY,QWAY,QJZ ; -
        DB      THERE-$
        DB      QEND
        MVI     C,2
; (fall into GXY)

; GXY - the block of a move in the plane
; In:  RGNUM, V; C = 2: X and Y; 4: I and J too, BX and BY   Out: W = V   Clobbers all
GXY:    PUSH    B
        CALL    GBLOCK
        DB      CALC,LVX,SWX,LVY,SWY,QEND ; -
        POP     B
        MVI     B,RFEED&255
        LXI     H,MVX
        LXI     D,GLETS
; (fall into GWORDS)

; GWORDS - the rest of a block with G: coordinates, and F where it is another one
; In:  HL -> first number, DE -> its letter, C = numbers, B = low byte of -> feed   Clobbers all
GWORDS: LDAX    D
        DB      PUTC
        INX     D
        PUSH    D
        PUSH    B
        MVI     B,9
        MVI     E,-3            ; um as mm
        CALL    PRNUMC
        POP     B
        POP     D
        DCR     C
        JNZ     GWORDS
        LXI     H,BLKOFF
        PUSH    H               ; comes last
        LDA     RGNUM
        ORA     A
        RZ                      ; a rapid has none
        MOV     E,B
        MVI     D,RFEED/256
        CALL    GETA            ; a0 = the feed
        LXI     D,RPUNF
        CALL    OOVR
        CALL    CMPNE
        RZ                      ; the same
        LXI     H,RPUNF
        PUSH    H
        CALL    PUTA
        POP     H
        MVI     A,CLTF
; (fall into PUTNUM)

; PUTNUM - a word that is no coordinate
; In:  A = letter, HL -> number   Out: HL -> behind it   Clobbers A, B, DE
PUTNUM: DB      PUTC
        MVI     B,8
        JMP     PRNUM

GLETS:  DB      "XYIJ"
GLETZ:  DB      "Z"

; GBLOCK - begins a block with G
; In:  RGNUM   Clobbers all
GBLOCK: CALL    BLOCK
        MVI     A,CLTG
        DB      PUTC
        LDA     RGNUM
        JMP     PUT1D

; STOP - after an error: M0   Clobbers all
STOP:   MVI     B,1
; (fall into PUNDS)

; PUNDS - B = 1: M0; B = 2: the tape ends, up and M30
; Clobbers all
PUNDS:  DCR     B
        PUSH    PSW
        CNZ     UP
        CALL    BLOCK
        MVI     A,CLTM
        DB      PUTC
        POP     PSW
        JZ      PUNDS1
        LXI     H,0
        SHLD    BLKNO           ; what comes next is another tape
        MVI     A,CZERO+3
        DB      PUTC
PUNDS1: MVI     A,CZERO
        DB      PUTC
        JMP     BLKOFF

; TAPE0 - has the tape begun?  Before it has, nothing is known of the machine
; Out: Z: it has not   Clobbers all
TAPE0:  LHLD    BLKNO
        MOV     A,H
        ORA     L
        RNZ
        STA     RPUNF
        MVI     A,NOWHER
        STA     MWX
        STA     MWZ
        RET                     ; (Z as it was)

; BLOCK - begins a block: its number; in front of a tape's first one what every tape begins with
; Clobbers all
BLOCK:  CALL    TAPE0
        JNZ     BLOCK1
        CALL    BLOCK1
        CALL    PUTSI
        DB      "G17G21G90G9",0B4H
        CALL    BLKOFF
BLOCK1: LHLD    BLKNO
        LXI     D,-LASTNO
        XCHG
        DAD     D
        JC      BLOCK2          ; (0)
        XCHG
BLOCK2: INX     H
        SHLD    BLKNO
        CALL    BLKON
        MVI     A,CLTN
        DB      PUTC
        JMP     PRDEC
