; drive.asm - the board follows the blocks itself, and steps two motors (drive.md)
; Offers: PUNOFF LETGO BDPUN SDRIV DNEW BDOFF BDRDY KEEP BDREST
; Uses:   [ports] [post] [punch] [start] decimal ends io monitor program run start value
; Room:   673 bytes
;
; Text is the one way in: DRIVE gives each character of the reader to DPUSH, RUN each one that it punches. DPUSH
; goes on in the middle of DLINE, which knows what may come, and has left its place in DPARS.  So a line is
; read and its numbers are made while the steps of the line before it are: a character each time that DLOOP has
; something else to see to.  At the line's end DLINE makes the rest of those steps; its own block is ready by then.
;
; What a block needs lies in a page, and there are two: one block is followed while the next one is read and made ready.
; A step goes along one of two records of its page, one for each axis:
;
;       U       the port with this axis's pulse up
;       R       what a step adds to F, high byte first
;       B       the port without a pulse
;       N       steps on this axis until DLOOP looks round, negative
;
; Record 1 is that of the block's x: on an arc it steps X and R = 2x+1, on a line Y and R = 2x (a line steps X
; where y is taken off F).  The record that leads inside, whose step F >= 0 wants, has the sign of R changed:
; 1-2p on an arc, of the coordinate p that shrinks; each of an arc's steps adds 2 to its own R.  So R comes
; from -1 to 1 where p comes to 0, which is a carry out of its highest byte: there the next quadrant begins, and the
; records exchange their roles.  The twofold F has the sign of tape-3b.md's.
;
; The steps of J are handed out in slices, as the N of the count axis: short ones while a line is being read,
; since a character is taken between two of them.  The N of the other axis may run out when it likes.

DRIVE   EQU 14H         ; the machine's port, out:
DYSTEP  EQU 04H         ; Y step
DSTEPS  EQU 05H         ; both step bits
DMINUS  EQU 0AH         ; both directions
DCUTS   EQU 80H         ; cutting
DMOST   EQU 12          ; numbers are below 12 * 2^24, x and y twofold
DSLICE  EQU 7FH         ; steps of a slice at most, less 1: all lower bits (not 0FFH: an N of 0 is a slice's end)
DSLIC1  EQU 1           ; the same while a line is being read

; Cells that RUN, NEW and a reset clear: those in front of N, and TOL's, which this image goes without
DPARS   EQU RUNCEL      ; -> place in DLINE; low byte 0: a line begins
DSTATE  EQU DPARS+2     ; bit 0: not cutting
DCHAR   EQU DPARS+3     ; the reader's character that is being seen to; 0: none
DCOUNT  EQU MTO         ; -> the count's N; high byte 0: no block is in hand
DHIGH   EQU MTO+2       ; bit 7: the feed clock has not fallen behind the last step

; Cells that float.asm leaves free
DNUMP   EQU FWORK+12    ; -> behind the number that is read; then -> DTURN
DAXIS   EQU DNUMP+2     ; 0 X, 1 Y

; Cells of FIT's, which holds nothing back here
DINC    EQU HELD        ; what a step adds to its own R: 2 on an arc, else 0
DMODE   EQU HELD+1      ; 0FEH: RUN drives, 0: it does not

; A block: the same places in two pages, behind the registers and in HELD
DPAGES  EQU 4           ; what the pages' numbers differ in
DTURN   EQU HELD+48H    ; low two bits: what is added to the quadrant: 0 line, 1 counter-clockwise, 3 clockwise;
                        ; with bit 2 the step of record 1: Y on a line, X on an arc
DQUAD   EQU DTURN+1     ; the quadrant that the motion points into, 0 to 3
DROLE   EQU DTURN+2     ; -> lowest R of the record that leads inside: F >= 0 steps it
DREST   EQU HELD+54H    ; J, high byte first; then what is left of it behind the slice
DFDEV   EQU HELD+58H    ; F, low byte first
DU2     EQU HELD+63H    ; record 2: the line's y
DR2     EQU DU2+1
DB2     EQU DU2+5
DN2     EQU DU2+6
DU1     EQU HELD+73H    ; record 1: the line's x
DR1     EQU DU1+1
DB1     EQU DU1+5
DN1     EQU DU1+6
DNUMS   EQU 16          ; from a number of the line to the next one, downwards
DTWICE  EQU 20H         ; bit of the address behind a number: x or y, not J
DCARRY  EQU 4           ; bit of the address of a byte of R: not U's

;! (MREG/100H+1) ^ HELD/100H == DPAGES and (HELD/100H) & DPAGES == DPAGES -- DLINE goes from page to page
;! DTURN&0FFH >= 320-256 and (DN1&0FFH) < 80H -- behind the registers, in front of the typed line
;! (DREST&3)+(DR2&3)+(DR1&3) == 0 and DR1-DR2 == DNUMS and DR2-DREST == DNUMS and DREST+4-DTURN == DNUMS -- DLINE walks along numbers
;! ((DR1+3)^(DR2+3)) == DNUMS -- DLOOP goes from one record to the other
;! DFDEV > DREST and DFDEV+4 <= DR1 -- F is cleared with the numbers
;! ((DR1+4)&DTWICE)*((DR2+4)&DTWICE) != 0 and ((DREST+4)&DTWICE) == 0 -- DLINE tells J from x and y
;! (DU1&DCARRY)+(DU2&DCARRY) == 0 and (DR1&DCARRY)*((DR1+2)&DCARRY) != 0 -- DCAR comes to U behind the bytes of R
;! (DR2&DCARRY)*((DR2+2)&DCARRY) != 0 -- the same
;! DCHAR == DSTATE+1 and DMODE < CLOSED and DCHAR < MNEXT and DHIGH < MTO+5 -- two cells are taken at once; nobody else's cells
;! (DSYN1&0FFH)*(DSYN2&0FFH)*(DSYN3&0FFH)*(DSYN4&0FFH)*(DSYN5&0FFH) != 0 -- DPUSH takes 0 for a line's beginning
;! (DSYN6&0FFH)*(DSYN7&0FFH)*(DSYN8&0FFH) != 0 -- the same

; DLOOP - steps, until there is something else to see to
; In:  B C D E = F, H = the block's page
; Out: Z: an N has run out; CY: the clock has not fallen behind the step; neither: it is low, or stop   Clobbers A, L
; Cycles: a step 293, with a carry 105 to 155 more, with a new quadrant 650
DLOOP:  IN      DRIVE
        ANI     3
        DCR     A
        RNZ
        MVI     L,DROLE&255
        MOV     A,B
        RAL
        SBB     A
        ANI     DNUMS           ; F < 0: the other record
        XRA     M
        MOV     L,A
        MOV     A,E
        ADD     M
        MOV     E,A
        DCR     L
        MOV     A,D
        ADC     M
        MOV     D,A
        DCR     L
        MOV     A,C
        ADC     M
        MOV     C,A
        DCR     L
        MOV     A,B
        ADC     M
        MOV     B,A
        DCR     L
        MOV     A,M             ; U
        OUT     DRIVE
        MOV     A,L
        ADI     4
        MOV     L,A
        LDA     DINC
        ADD     M
        MOV     M,A
        CC      DCAR
        IN      DRIVE
        RAR
        INR     L
        MOV     A,M             ; B
        OUT     DRIVE
        INR     L
        INR     M               ; N
        RC
        JNZ     DLOOP
        RET

; DCAR - carries into the higher bytes of R; out of them: the next quadrant
; In:  HL -> lowest byte   Clobbers A
DCAR:   PUSH    H
        PUSH    B
DCAR1:  DCR     L
        INR     M               ; (behind R's highest byte U, which never comes to 0)
        JZ      DCAR1
        MOV     A,L
        ANI     DCARRY          ; out of R: DIRS makes U anew
        CZ      DIRS
        POP     B
        POP     H
        RET

; PUNOFF - punch off, the block is complete: the place for a break; after DRIVE 1 a running program's is followed
; Out: ERR 10, also when it was stopped   Clobbers all
PUNOFF: CALL    PAPON
; (fall into LETGO)

; LETGO - a line of the program begins, before anything of it is done: looks for a break; after DRIVE 1 the rest of a
;         block that was stopped comes first, and what was read ahead of a tape is forgotten
; Out: ERR 10, also when it was stopped   Clobbers all
LETGO:  CALL    BREAK
        CALL    DASKED
        RZ
; (fall into DFIN)

; DFIN - the rest of the block in hand; a line begins
; Out: A = 0; ERR 10 as DSTEP   Clobbers all
DFIN:   MVI     C,DSLICE
        CALL    DSTEP
        JNZ     DFIN
        STA     DPARS
        RET

; BDPUN - punches a character (TYPECH of io.asm calls it); DLINE gets it when RUN drives
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
        MVI     C,DSLIC1
        CALL    DSTEP
        CZ      BREAK
        IN      TTYST
        ANI     TXRDY           ; (no step waits for the teletype)
        CNZ     BDREAD
        RZ
        STA     DCHAR
        DB      PUTC
; (fall into DPUSH)

; DPUSH - takes a character of a tape
; In:  A   Out: ERR 10   Clobbers all
DPUSH:  LHLD    DPARS
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
; In, Out: as DNEXT; ERR 10   Clobbers all
DNEXZ:  JNZ     DERR
; (fall into DNEXT)

; DNEXT - DLINE comes back with the next character, one of so many from a first one on: that, and how many, stand
;         behind the call
; In:  nothing on the stack but who called DPUSH   Out: A = character, counted from that first one, S and Z of it
; Clobbers all
DNEXT:  POP     H
        SHLD    DPARS
        RET

; DLINE - takes a line, character by character; its block is in hand then, when the one before it has been followed
; In:  A = first character   Out: ERR 10   Clobbers all
DLINE:  SUI     CZERO
        RC                      ; between the lines
        CPI     CLTD-CZERO
        JZ      DSTOP
        MOV     C,A
        LDA     DCOUNT+1        ; the other page than that of the block in hand
        ANI     DPAGES
        XRI     HELD/256
        MOV     H,A
        MVI     L,DREST&255
        MVI     B,DR1+4-DREST
        MOV     A,C
        CALL    WIPE
        SHLD    DNUMP
DLIN1:  CPI     CLTB-CZERO
        CALL    DNEXZ
DSYN1:  DB      CZERO,10
DLIN2:  LHLD    DNUMP
        MOV     B,A
        MOV     A,L
        ANI     DTWICE          ; x and y are made twofold, J is not
        MOV     A,B
        JZ      DLIN3
        ADD     A
DLIN3:  DCX     H               ; 10x+digit, byte by byte
        MOV     E,M
        MVI     D,0
        PUSH    H
        CALL    TEN
        XCHG
        POP     H
        MOV     M,E
        MOV     A,L
        ANI     3
        MOV     A,D
        JNZ     DLIN3
        MOV     A,M
        CPI     DMOST
        JNC     DERR
        CALL    DNEXT
DSYN2:  DB      CZERO,CLTG-CZERO+1
        CPI     10
        JC      DLIN2
        MOV     B,A
        LXI     H,DNUMP
        MOV     A,M
        SUI     DNUMS
        MOV     M,A
        CPI     DTURN&255
        MOV     A,B
        JNZ     DLIN1
        CPI     CLTG-CZERO
        CALL    DNEXZ
DSYN3:  DB      CLTY-1,2
        STA     DAXIS
        CALL    DNEXT
DSYN4:  DB      CLTL,CLTS-CLTL+1
        RRC                     ; L 0, N 1, S 83H (Z stays)
        LHLD    DNUMP
        MVI     M,DYSTEP        ; (DIRS takes the line's step from there)
        JZ      DLIN5
        MOV     M,A
        MVI     L,(DR1+3)&255   ; an arc: 2x+1, 2y+1
        INR     M
        MVI     L,(DR2+3)&255
        INR     M
        DCR     A
        JZ      DLIN4
        CPI     82H
DLIN4:  CALL    DNEXZ
DSYN5:  DB      CLTR,1
DLIN5:  CALL    DNEXT
DSYN6:  DB      CZERO+1,4
        LHLD    DNUMP
        INX     H
        MOV     M,A
        CALL    DIRS
        CALL    DNEXT
DSYN7:  DB      0,CZERO
        CALL    DFIN
        LHLD    DNUMP
        MOV     A,M
        ADD     A
        ANI     2
        STA     DINC
        LDA     DAXIS
        XRA     M
        RAR                     ; CY: record 1 counts
        SBB     A
        ANI     DN1-DN2
        ADI     DN2&255
        MOV     L,A
        MVI     M,0             ; (the first slice is to come)
        SHLD    DCOUNT
        RET

; DSTEP - steps of the block in hand, until there is something else to see to
; In:  C = mask of J's low byte: what it leaves out is how long a slice may be, less 1
; Out: Z: no block is in hand any more, A = 0; ERR 10 when the operator or bit 1 stops it, HL-> KEYB
; Clobbers all
DSTEP:  LHLD    DCOUNT
        MOV     A,H
        ORA     A
        RZ
        MOV     A,M
        ORA     A
        JNZ     DSTE3
        XCHG                    ; the next slice: J-1 is cut at the mask, both parts are kept
        MOV     H,D
        MVI     L,(DREST+3)&255
        MVI     B,4
DSTE1:  MOV     A,M
        DCR     M
        ORA     A
        JNZ     DSTE2
        DCR     L
        DCR     B
        JNZ     DSTE1
        STA     DCOUNT+1        ; there is none
        RET
DSTE2:  MVI     L,(DREST+3)&255
        MOV     A,M
        ANA     C
        CMA
        STAX    D
        ANA     M
        MOV     M,A
DSTE3:  CALL    POLL
        JZ      BROKEN          ; (BDOFF puts the machine off)
        IN      DRIVE
        RAR
        RAR
        JC      BROKEN          ; bit 1
        LXI     H,DHIGH
        ANA     M
        RM                      ; the clock is still high
        LHLD    DCOUNT
        DCR     L
        MOV     A,M             ; B
        OUT     DRIVE
        MVI     L,DFDEV&255
        MOV     E,M
        INR     L
        MOV     D,M
        INR     L
        MOV     C,M
        INR     L
        MOV     B,M
        CALL    DLOOP
        RAR
        STA     DHIGH
        MVI     L,DFDEV&255
        MOV     M,E
        INR     L
        MOV     M,D
        INR     L
        MOV     M,C
        INR     L
        MOV     M,B
        ORA     H               ; (not 0)
        RET
; DSTOP - the line begins with D: the end of the tape, or off, and a key comes before the next block
; Out: ERR 10   Clobbers all
DSTOP:  CALL    DNEXT
DSYN8:  DB      CLTD,CZERO-CLTD ; all but '0' to 'C'
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

; DEND - the end of the tape: back to RUN when it has punched it, else goes to READY
; Clobbers all
DEND:   CALL    DENDS
        CALL    DASKED
        RNZ                     ; RUN has punched it
        JMP     CRRDY           ; CR LF, and the prompt

; DIRS - directions and roles of the next quadrant; the record that leads inside changes the sign of R
; In:  H = page: DTURN, DQUAD; DSTATE
; Out: ERR 10: an arc begins where its coordinate cannot shrink   Clobbers A, B, C, L
DIRS:   MVI     L,DTURN&255
        MOV     C,M
        INR     L
        MOV     A,M
        ADD     C
        ANI     3
        MOV     M,A
        LDA     DSTATE
        RRC
        ANI     DCUTS
        ADD     M               ; and 3 times the quadrant, and 4: bit 3 is the Y direction, bit 1 the X direction
        ADD     M
        ADD     M
        ADI     DCUTS+4
        ANI     DCUTS+DMINUS
        MOV     B,A
        MOV     A,C
        RRC
        XRA     M
        RRC
        SBB     A
        ANI     DNUMS
        XRI     (DR2+3)&255
        INR     L
        MOV     M,A             ; DROLE
        MVI     L,DB1&255
        MOV     M,B
        MVI     L,DB2&255
        MOV     M,B
        MOV     A,C
        ANI     DSTEPS          ; X on an arc, Y on a line
        ORA     B
        MVI     L,DU1&255
        MOV     M,A
        XRI     DSTEPS
        MVI     L,DU2&255
        MOV     M,A
        MOV     A,C
        ADD     A
        ANI     2               ; (CY clear)
        MOV     C,A             ; 2 on an arc, else 0
        MVI     L,DROLE&255
        MOV     L,M
        MVI     B,4
DIRS3:  SBB     M
        MOV     M,A
        DCR     L
        MVI     A,0
        DCR     B
        JNZ     DIRS3
        RC
        ORA     C
        RZ                      ; a line along an axis
        LDA     DCOUNT+1
        CMP     H
        CZ      SDRI7           ; it is the block in hand: there is none (what DERR does of it again changes nothing)
; (fall into DERR)

; DERR - the line is none: that counts when the block in hand has been followed; goes to ERR, number 10
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
; Out: A = 0   Clobbers nothing else
BDOFF:  LDA     NXTP+1
        ORA     A
        JZ      BDOFF1
        XRA     A
        STA     DSTATE          ; a program's tape is broken off: what runs next begins with cutting
BDOFF1: STA     LOADF
        OUT     DRIVE
        RET

; BDRDY - at the prompt: the machine is off (a subroutine of a program may end in mid-tape)
; Out: HL-> VSUM   Clobbers A
BDRDY:  XRA     A
        OUT     DRIVE
        LXI     H,VSUM
        RET

; KEEP - what a reset leaves of program and variables: nothing
; In:  HL -> last byte of RAM   Out: VTOP   Clobbers all
KEEP:   SHLD    VTOP
        JMP     NEWPRG

; BDREST - what is readied at reset besides the serial ports (the machine's port is cleared by the reset itself); goes to RESET
BDREST: XRA     A
        STA     DMODE
        JMP     RESET
