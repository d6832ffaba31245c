; drive.asm - the board follows the blocks itself, and steps two motors (drive.md)
; Offers: PUNOFF BDPUN SDRIV DNEW BDOFF BDREST
; Uses:   cut decimal float io io_6850 io_port io_punch monitor reset start tape value
; Room:   700 bytes
;
; Text is the one way in: DRIVE gives each character of the reader to DPUSH, RUN each one that it punches. DPUSH
; goes on in the middle of DLINE, which knows what may come, and has left its place in DPARS.  So a line is
; read and its numbers are made while the steps of the line before it are: a character each time that DLOOP has
; something else to see to.  At the line's end DLINE makes the rest of those steps, and sets its own block up.
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
DMINUS  EQU 0AH         ; both directions
DCUTS   EQU 80H         ; cutting
DBELOW  EQU 0D0H        ; the lowest character, less '0'
DMOST   EQU 6           ; numbers are below 6 * 2^24

; Cells that RUN, NEW and a reset clear: those in front of N, and TOL's, which this image goes without
DPARS   EQU RUNCEL      ; -> place in DLINE; low byte 0: a line begins
DSTATE  EQU DPARS+2     ; bit 0: not cutting
DCHAR   EQU DPARS+3     ; the reader's character that is being seen to; 0: none
DCOUNT  EQU MTO         ; -> the count's N; high byte 0: no block is in hand
DHIGH   EQU MTO+2       ; bit 7: the feed clock has not fallen behind the last step

; Cells that float.asm leaves free
DNUMP   EQU FWORK+12    ; -> behind the number that is read
DAXIS   EQU DNUMP+2     ; 0 X, 1 Y
DKIND   EQU DNUMP+3     ; as DTURN
DFIRST  EQU DNUMP+4     ; quadrant, from 0

; Cells of FIT's, which holds nothing back here
DX      EQU HELD        ; the line that is read: J y x, high byte first
DN1     EQU DX+12       ; record 1,
DR1     EQU DN1+4
DU1     EQU DN1+8
DN2     EQU DN1+9       ; record 2
DR2     EQU DN1+13
DU2     EQU DN1+17
DROLE   EQU DN1+18      ; bit 7: F >= 0 steps record 2
DBASE   EQU DN1+19      ; the port without a pulse
DINC    EQU DN1+20      ; what a step adds to its own R: 2 on an arc, else 0
DTURN   EQU DN1+21      ; low two bits: what is added to the quadrant: 0 line, 1 counter-clockwise, 3 clockwise
DQUAD   EQU DN1+22      ; the quadrant that the motion points into, 0 to 3
DFDEV   EQU DN1+23      ; F
DMODE   EQU DN1+27      ; 0FEH: RUN drives, 0: it does not

;! DX & 0FFH == 0 and DFIRST < FSP -- DLINE sees by the low address that a number, and the last one, has been read
;! DN1/100H == DU2/100H -- the loop changes L alone
;! DU2-DU1 == 9 and DR2-DR1 == 9 and DN2-DN1 == 9 and DR1-DN1 == 4 and DU1-DR1 == 4 -- DLOOP walks along a record
;! DN2 == DU1+1 and DQUAD == DTURN+1 and DFIRST == DKIND+1 and DCHAR == DSTATE+1 -- two cells are taken at once
;! DMODE < CLOSED and DCHAR < MNEXT and DHIGH < MTO+5 -- nobody else's cells
;! (DSYN1&0FFH)*(DSYN2&0FFH)*(DSYN3&0FFH)*(DSYN4&0FFH)*(DSYN5&0FFH) != 0 -- DPUSH takes 0 for a line's beginning
;! (DSYN6&0FFH)*(DSYN7&0FFH)*(DSYN8&0FFH) != 0 -- the same

; DLOOP - steps, until there is something else to see to
; In:  B C D E = F, H = DN1/256
; Out: Z: the low byte of an N has run out, HL -> it; CY: the clock has not fallen behind the step; neither: it is low,
;      or stop   Clobbers A, HL
; Cycles: a step 293, with a carry 20 to 60 more, with a new quadrant 700
DLOOP:  IN      DRIVE
        ANI     3
        DCR     A
        RNZ
        MVI     L,DR2&255
        LDA     DROLE
        XRA     B
        JM      DLOO1
        MVI     L,DR1&255
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

; PUNOFF - punch off, the block is complete: the place for a break; after DRIVE 1 a running program's is followed
; Out: ERR 10, also when it was stopped   Clobbers all
PUNOFF: CALL    PAPON
        CALL    DASKED
        RZ
; (fall into DFIN)

; DFIN - the rest of the block in hand; a line begins
; Out: A = 0; ERR 10 as DSTEP   Clobbers all
DFIN:   CALL    DSTEP
        JNZ     DFIN
        STA     DPARS
        RET

; BDPUN - punches a character (PUTC1 of io.asm calls it); DLINE gets it when RUN drives
; In:  B   Out: ERR 10   Clobbers A, B, C, HL
BDPUN:  CALL    BDPUT
        CALL    DASKED
        RZ
        MOV     A,B
        PUSH    D
        CALL    DPUSH
        POP     D
        RET

; DASKED - is what is punched to be followed?
; Out: Z: no: not asked for, or no program runs, or it is over with an error   Clobbers A, HL
DASKED: LHLD    NXTP+1          ; and CHKF
        DCR     H               ; 0FFH, after an error 1
        LDA     DMODE
        ANA     L
        ANA     H
        RET

; SDRIV - command: DRIVE follows the reader's tape; DRIVE 1, DRIVE 0: RUN drives, or not
SDRIV:  DB      PEEK
        JNZ     SDRI9
        DB      CHKEND
        LDA     DCOUNT+1
        ORA     A
        CNZ     DKEY            ; the block that was stopped
        LDA     DCHAR
        ORA     A
        CNZ     DPUSH           ; the stop came first: this character waited for the block's end
SDRI1:  LXI     H,SDRI1         ; every character returns there
        PUSH    H
        XRA     A
        STA     DCHAR
        CALL    DSTEP
        CZ      BREAK
        IN      TTYST
        ANI     TXRDY           ; (no step waits for the teletype)
        RZ
        CALL    BDREAD
        ANI     7FH
        RZ
        STA     DCHAR
        DB      PUTC
; (fall into DPUSH)

; DPUSH - takes a character of a tape
; In:  A   Out: ERR 10   Clobbers all
DPUSH:  SUI     CZERO
        LHLD    DPARS
        INR     L
        DCR     L
        JZ      DLINE
        SUB     M
        INX     H
        CMP     M
        INX     H
        JNC     DERR
        ORA     A
        PCHL

; DNEXZ - DNEXT where Z is set, else the character is wrong
DNEXZ:  JNZ     DERR
; (fall into DNEXT)

; DNEXT - DLINE comes back with the next character, one of so many from a first one on: that, less '0', and how
;         many stand behind the call
; In:  nothing on the stack but who called DPUSH   Out: A = character, counted from that first one, S and Z of it
; Clobbers all
DNEXT:  POP     H
        SHLD    DPARS
        RET

; DLINE - takes a line, character by character; at its end the block is in hand, and its first steps are made
; In:  A = first character, less '0'   Out: ERR 10   Clobbers all
DLINE:  ORA     A
        RM                      ; between the lines
        CPI     CLTD-CZERO
        JZ      DSTOP
        LXI     H,DX
        MVI     B,12
        CALL    RTDON1          ; (clears)
        SHLD    DNUMP
DLIN1:  CPI     CLTB-CZERO
        CALL    DNEXZ
DSYN1:  DB      0,10
DLIN2:  LHLD    DNUMP
        LXI     D,10
        MOV     C,A             ; 10x+digit, byte by byte
        MVI     B,0
DLIN3:  DCX     H
        MOV     A,M
        PUSH    H
        CALL    FMUL2
        POP     H
        MOV     M,A
        MOV     A,L
        ANI     3
        JNZ     DLIN3
        MOV     A,M
        CPI     DMOST
        JNC     DERR
        CALL    DNEXT
DSYN2:  DB      0,CLTG-CZERO+1
        CPI     10
        JC      DLIN2
        MOV     B,A
        LXI     H,DNUMP
        MOV     A,M
        SUI     4
        MOV     M,A
        MOV     A,B
        JNZ     DLIN1
        CPI     CLTG-CZERO
        CALL    DNEXZ
DSYN3:  DB      CLTY-1-CZERO,2
        STA     DAXIS
        CALL    DNEXT
DSYN4:  DB      CLTL-CZERO,CLTS-CLTL+1
        RRC                     ; L 0, N 1, S 83H (Z stays)
        STA     DKIND
        JZ      DLIN5
        DCR     A
        JZ      DLIN4
        CPI     82H
DLIN4:  CALL    DNEXZ
DSYN5:  DB      CLTR-CZERO,1
DLIN5:  CALL    DNEXT
DSYN6:  DB      1,4
        STA     DFIRST
        CALL    DNEXT
DSYN7:  DB      DBELOW,100H-DBELOW
        CALL    DFIN
        LHLD    DKIND           ; and DFIRST
        SHLD    DTURN           ; and DQUAD
        LDA     DAXIS
        XRA     L
        RAR                     ; CY: record 1 counts
        SBB     A
        ANI     (DN1-DN2)&255
        ADI     (DN2+3)&255
        MOV     C,A             ; -> its N's low byte
        LXI     D,DX+12
        LXI     H,DR1
        CALL    DTWICE
        INX     H
        MOV     M,A             ; N of record 2 (A is positive: the one that does not count will never run out)
        MVI     L,DR2&255
        CALL    DTWICE
        STA     DN1
        MOV     L,C
        MVI     B,4
        STC
DLIN6:  DCX     D               ; N = -J
        LDAX    D
        CMA
        ACI     0
        MOV     M,A
        DCX     H
        DCR     B
        JNZ     DLIN6
        RC                      ; J = 0 is no block
        INX     H
        SHLD    DCOUNT
        CALL    DIRS
        MOV     H,B             ; (DIRS leaves B = 0)
        MOV     L,B
        SHLD    DFDEV
        SHLD    DFDEV+2
; (fall into DSTEP)

; DSTEP - steps of the block in hand, until there is something else to see to
; Out: Z: no block is in hand any more, A = 0; ERR 10 when the operator or bit 1 stops it: the steps to go are typed
; Clobbers all
DSTEP:  LDA     DCOUNT+1
        ORA     A
        RZ
        CALL    POLL
        JZ      DSTE3           ; a break
        IN      DRIVE
        RAR
        RAR
        JC      DSTE3           ; bit 1
        LXI     H,DHIGH
        ANA     M
        RM                      ; the clock is still high
        LHLD    DFDEV
        XCHG
        LHLD    DFDEV+2
        MOV     B,H
        MOV     C,L
        LDA     DBASE
        OUT     DRIVE
        MVI     H,DN1/256
        CALL    DLOOP
        RAR                     ; (leaves Z alone)
        STA     DHIGH
        JNZ     DSTE2
        MVI     A,3
DSTE1:  DCR     L
        INR     M
        JNZ     DSTE2
        DCR     A
        JNZ     DSTE1
        STA     DCOUNT+1
        RET
DSTE2:  XCHG
        SHLD    DFDEV
        MOV     H,B
        MOV     L,C
        SHLD    DFDEV+2
        RET
DSTE3:  XRA     A
        MOV     M,A             ; no key is typed ahead
        OUT     DRIVE
        CALL    CRLF
        LHLD    DCOUNT
        CALL    FLOAD           ; (the highest bit is 1 anyway)
        XRA     A
        SUB     E
        MOV     L,A
        MVI     E,0
        MOV     A,E
        SBB     D
        MOV     H,A
        MOV     A,E
        SBB     C
        MOV     C,E             ; (no power of ten)
        MOV     E,A
        MOV     A,C
        SBB     B
        MOV     D,A
        CALL    DECOU1
        DB      ERROR,ETAPE

; DTWICE - R of a coordinate: doubled, and 1 on an arc
; In:  DE -> behind its low byte, HL -> R, DTURN   Out: A = highest byte, DE -> highest byte   Clobbers B, HL
DTWICE: LDA     DTURN
        RRC
        MVI     B,4
DTWI1:  DCX     D
        LDAX    D
        RAL
        MOV     M,A
        INX     H
        DCR     B
        JNZ     DTWI1
        RET

; DSTOP - the line begins with D: the end of the tape, or off, and a key comes before the next block
DSTOP:  CALL    DNEXT
DSYN8:  DB      CLTD-CZERO,DBELOW+CLTD-CZERO+8 ; all but '0' to 'C'
        JZ      DEND
        JP      DERR
        CALL    DFIN
        OUT     DRIVE
        LXI     H,DSTATE
        INR     M
; (fall into DKEY)

; DKEY - waits for a key
; Out: ERR 10   Clobbers A, HL
DKEY:   XRA     A
        STA     KEYB            ; none that is typed ahead
DKEY1:  CALL    BREAK
        ORA     A
        JZ      DKEY1
        MVI     M,0
        RET

; DEND - the end of the tape
DEND:   CALL    DENDS
        CALL    DASKED
        RNZ                     ; RUN has punched it
        JMP     ERR5            ; CR LF, and the prompt

; DIRS - directions and roles of the next quadrant; the record that leads inside changes the sign of R
; In:  DTURN, DQUAD, DSTATE   Out: B = 0; ERR 10: an arc begins where its coordinate cannot shrink   Clobbers A, B, C, HL
DIRS:   LHLD    DTURN           ; and DQUAD
        MOV     A,L
        ADD     H
        ANI     3
        STA     DQUAD
        MOV     C,A
        ADD     A
        ADD     A               ; bit 3: Y direction
        INR     C
        ORA     C               ; bit 1: X direction
        ANI     DMINUS
        MOV     B,A
        LDA     DSTATE
        INR     A
        RRC
        ANI     DCUTS
        ORA     B
        STA     DBASE
        MOV     B,A
        MOV     A,L
        RRC
        MOV     L,A
        SBB     A
        MOV     H,A
        ANI     DSTEPS
        XRI     DYSTEP          ; X on an arc, Y on a line
        ORA     B
        STA     DU1
        XRI     DSTEPS
        STA     DU2
        MOV     A,H
        ANI     2
        STA     DINC
        MOV     B,A
        MOV     A,L
        XRA     C
        MOV     C,B
        RRC
        STA     DROLE
        LXI     H,DR2
        JC      DIRS2
        MVI     L,DR1&255
DIRS2:  MOV     A,C
        ORA     A
        MVI     B,4
DIRS3:  SBB     M
        MOV     M,A
        INR     L
        MVI     A,0
        DCR     B
        JNZ     DIRS3
        RC
        ORA     C
        RZ                      ; a line along an axis
        CALL    SDRI7           ; (no block is in hand; what DERR does of it again changes nothing)
; (fall into DERR)

; DERR - the line is none: that counts when the block in hand has been followed
DERR:   CALL    DENDS
        DB      ERROR,ETAPE

; DNEW - command: NEW, which ends DRIVE 1 too
DNEW:   CALL    SNEW
        XRA     A
        JMP     SDRI8

SDRI9:  CALL    LNEND
        LXI     H,-2
        DAD     D
        JC      ERRNG
        XRA     A
        SUB     E
        ADD     A
SDRI8:  STA     DMODE
SDRI7:  XRA     A               ; (DIRS comes in here)
        STA     DCOUNT+1        ; a block that was stopped is forgotten
; (fall into DENDS)

; DENDS - the rest of the block in hand; the tape ends, the machine is off
; Clobbers all
DENDS:  CALL    DFIN
        MOV     H,A
        MOV     L,A
        SHLD    DSTATE          ; and DCHAR
; (fall into BDOFF)

; BDOFF - after an error and at a program tape's end: no more lines from the reader; the machine is off
; Out: A = 0
BDOFF:  XRA     A
        STA     LOADF
        OUT     DRIVE
        RET

; BDREST - what is readied at reset besides the serial ports (the machine's port is cleared by the reset itself)
; Clobbers A
BDREST: XRA     A
        STA     DMODE
        JMP     RESET
