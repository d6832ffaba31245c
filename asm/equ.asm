; equ.asm - names of characters, errors, kinds, tokens, registers and the cells in RAM that all files know
; Offers: names for all
;
; In the other headers Offers: lists the names that other files use, routines, cells and equates
; alike, in the order in which they are defined; Uses: the files whose names are used; Room: the
; bytes that the file may have.  What this file defines counts nowhere.  asm/rooms.py --headers
; writes the first two lines, tests/rom/test_rooms.py checks all three.

; ---- Names -----------------------------------------------------------------
; The first letter of a name says what it is, where it is one of many:
;   Q  byte-code: an operation or a constant       L  byte-code: pushes a register
;   S  byte-code: pops into a register; or the routine of a statement (SCUT, STEND)
;   X  routine of an operation that geometry, route or tape add to the calculator
;   O  routine of an operation of the calculator itself   F  routine of float.asm
;   G  byte-code of an operation of the language   M  address of a register, or of several
;   T  token        K  kind of value       E  number of an error    ER  its DB ERROR
;   C  character    R  cell of the route   Z  mark of the build
; A digit or letter behind a routine's name is a place within it; no other file goes there.  (A 0 is a restart's
; routine, a 5 or 15 a count of bytes.)
;
; A line ";! fact -- who relies on it" is checked by the build (asm/facts.py).

; ---- Characters -----------------------------------------------------------
CCTLC   EQU 03H         ; break
CBS     EQU 08H
CLF     EQU 0AH
CCR     EQU 0DH
CXON    EQU 11H         ; ctrl-Q
CDC2    EQU 12H         ; punch on
CXOFF   EQU 13H         ; ctrl-S
CDC4    EQU 14H         ; punch off
CCTLU   EQU 15H         ; forget the line
CEOF    EQU 1AH         ; ctrl-Z, end of a program tape
CBLANK  EQU 20H
CQUOTE  EQU 22H
CRUB    EQU 7FH
;! (CXON & NOKEY) == 0 and (CXOFF & NOKEY) == 0 -- ctrl-Q and ctrl-S take no key's place
NOKEY   EQU 0ECH        ; bits of a key that waits: of it, no other one may take the place
CLOST   EQU 0BFH        ; a character has been lost here; it is printed as a question mark
CLPAR   EQU 28H         ; (
CRPAR   EQU 29H         ; )
CPLUS   EQU 2BH         ; +
CCOMMA  EQU 2CH         ; ,
CMINUS  EQU 2DH         ; -
CPOINT  EQU 2EH         ; .
CZERO   EQU 30H
CSEMI   EQU 3BH         ; ;
CLESS   EQU 3CH         ; <
CEQU    EQU 3DH         ; =
CGT     EQU 3EH         ; >
CPRMPT  EQU 3EH         ; > in front of what is typed
CLBRK   EQU 5BH         ; [
CRBRK   EQU 5DH         ; ]
CMARK   EQU 5EH         ; ^ below what is not understood
CLTB    EQU 42H         ; letters on the tape
CLTD    EQU 44H
CLTE    EQU 45H         ; (of an exponent)
CLTF    EQU 46H
CLTG    EQU 47H
CLTL    EQU 4CH
CLTM    EQU 4DH
CLTN    EQU 4EH
CLTP    EQU 50H
CLTR    EQU 52H
CLTS    EQU 53H
CLTT    EQU 54H
CLTY    EQU 59H
CLOWA   EQU 61H         ; a

; ---- Restarts -------------------------------------------------------------
; One byte each, written as data: assemblers do not agree on what stands behind RST
; (1 ... 7, or 8 ... 38H). The names of the bytes are start.asm's.
;   DB ERROR,n      statement ends with ERR n
;   DB PUTC         A to the paper (and the punch when it is on)
;   DB NEXT         A = next token, token pointer past it
;   DB EXPECT,t     next token must be t, else ERR 01
;   DB CALC,...     byte-code follows, up to QEND
;   DB PEEK         A = next token, pointer stays
;   DB CHKEND       the statement must end here

; ---- Skip bytes --------------------------------------------------------------
; The opcode of an instruction whose operand is the instruction that stands behind it: who
; comes to the skip byte passes that over, who jumps behind it carries it out.
SKIP1   EQU 0FEH        ; CPI: one byte, the flags are lost
SKIP1B  EQU 06H         ; MVI B: one byte, B is lost
SKIP2   EQU 3AH         ; LDA: two bytes, A is lost (the address read does not matter)
SKIP2B  EQU 01H         ; LXI B: two bytes, B and C are lost

; ---- Errors (language.md, section 6) ----------------------------------------
ESYN    EQU 1           ; not understood
ELINE   EQU 2           ; no such line, RETURN without GOSUB
EUNSET  EQU 3           ; name without a value
EKIND   EQU 4           ; kinds cannot be combined
ERANGE  EQU 5           ; number out of range
EGEOM   EQU 6           ; geometry impossible
EOFFS   EQU 7           ; the offset leaves nothing of a radius
EDATA   EQU 8           ; out of DATA
EMEM    EQU 9           ; memory full
ETAPE   EQU 10H         ; 10: block does not fit, reader ran out, operator broke in

; ---- Kinds of value --------------------------------------------------------
KNUM    EQU 0           ; one float
KPNT    EQU 1           ; x, y
KCIR    EQU 2           ; x, y, r
KLIN    EQU 3           ; alpha, beta, gamma
KTURN   EQU 4           ; angle, x, y: only as right side of #

; ---- Tokens ----------------------------------------------------------------
; 00 ends a line. Printing ASCII stands for itself ( ( ) ] , ; : # * / + - = < > ).
TEOL    EQU 00H
TFLT    EQU 01H         ; five bytes of float follow
; 80H...B7H: a name; letter index * 4 + subscript high bits, then subscript low byte
TNAME   EQU 80H
NAMER   EQU 8800H       ; the name R, the offset
; B8H...C5H: letter index of a name whose subscript is computed: tokens of an
; expression follow, then "]"
TSUB    EQU 0B8H
;! TSUB == TNAME+4*14 and (TSUB & 15) == 8 -- LIST4 makes a letter of its low half by one XRI
; letter indices: A D R I J (numbers) P O V (points) C B T (circles) S X Y (lines)
; The words' tokens, from TSQR up, are in words.asm, which the build makes of words.txt:
; functions first, then statements, then commands; the letters, which end KEYTAB, come to
; the end of a byte

; ---- Calculator registers M0...M63 -------------------------------------------
; Lxx pushes a register, Sxx pops into it: one byte of byte-code each.
MNODE1  EQU MREG        ; nodes of FIT, both in one page: place, tangent, offset
MNODE2  EQU MREG+25
MT0     EQU MREG+50     ; temporary registers; t4 and t5 lie in front of a
MT4     EQU MREG+70
MA      EQU MREG+80     ; address of a0: value, and left operand
MVB     EQU MREG+95    ; address of b0: right operand
MCUR    EQU MREG+114    ; elements: kind, three numbers, offset; behind C and F the place of entry
MC2     EQU MREG+125
MNEXT   EQU MREG+149
MNR     EQU MREG+165
MTO     EQU MREG+170
MHX     EQU MREG+175
MFIRST  EQU MREG+199
MKX     EQU MREG+230
MO1     EQU MREG+280
MBX     EQU MREG+290
ELSIZE  EQU 21          ; bytes of an element
PLCSIZ  EQU 10          ; of a place
L1X     EQU 040H
S1X     EQU 080H        ; M0 node 1 of FIT: place,
L1Y     EQU 041H
S1Y     EQU 081H        ; M1
L1U     EQU 042H
S1U     EQU 082H        ; M2 unit tangent, 0 0 when not known;
L1V     EQU 043H
S1V     EQU 083H        ; M3
LRT     EQU 044H
SRT     EQU 084H        ; M4 what SYM and REP do to items (they end a curve first): how many times
LMX     EQU 044H
SMX     EQU 084H        ; M4 too: joint of a biarc, seen from node 1 (whose offset is used up): x
L2X     EQU 045H
S2X     EQU 085H        ; M5 node 2 of FIT: as node 1,
L2Y     EQU 046H
S2Y     EQU 086H        ; M6
L2U     EQU 047H
S2U     EQU 087H        ; M7
L2V     EQU 048H
S2V     EQU 088H        ; M8
L2R     EQU 049H
S2R     EQU 089H        ; M9 and its offset
LRA     EQU 047H
SRA     EQU 087H        ; M7, M8, M9 too: what SYM and REP do to items
LRX     EQU 048H
SRX     EQU 088H
LRY     EQU 049H
SRY     EQU 089H
LT0     EQU 04AH
ST0     EQU 08AH        ; M10 temporary
LT1     EQU 04BH
ST1     EQU 08BH        ; M11
LT2     EQU 04CH
ST2     EQU 08CH        ; M12
LT3     EQU 04DH
ST3     EQU 08DH        ; M13
LT4     EQU 04EH
ST4     EQU 08EH        ; M14 temporary
LT5     EQU 04FH
ST5     EQU 08FH        ; M15
LA0     EQU 050H
SA0     EQU 090H        ; M16 value, and left operand
LA1     EQU 051H
SA1     EQU 091H        ; M17
LA2     EQU 052H
SA2     EQU 092H        ; M18
LB0     EQU 053H
SB0     EQU 093H        ; M19 right operand
LB1     EQU 054H
SB1     EQU 094H        ; M20
LB2     EQU 055H
SB2     EQU 095H        ; M21
LC0     EQU 057H
SC0     EQU 097H        ; M23 current element: canonical numbers
LC1     EQU 058H
SC1     EQU 098H        ; M24
LC2     EQU 059H
SC2     EQU 099H        ; M25
LCR     EQU 05AH
SCR     EQU 09AH        ; M26 its offset
LAX     EQU 05BH
SAX     EQU 09BH        ; M27 where the wire entered C
LAY     EQU 05CH
SAY     EQU 09CH        ; M28
LN0     EQU 05EH
SN0     EQU 09EH        ; M30 next element: canonical numbers
LN1     EQU 05FH
SN1     EQU 09FH        ; M31
LN2     EQU 060H
SN2     EQU 0A0H        ; M32
LNR     EQU 061H
SNR     EQU 0A1H        ; M33 its offset
LTO     EQU 062H
STO     EQU 0A2H        ; M34 tolerance of FIT, mm
LHX     EQU 063H
SHX     EQU 0A3H        ; M35 start hole: the FROM point
LHY     EQU 064H
SHY     EQU 0A4H        ; M36
LWX     EQU 065H
SWX     EQU 0A5H        ; M37 wire, whole um
LWY     EQU 066H
SWY     EQU 0A6H        ; M38
LF0     EQU 068H
SF0     EQU 0A8H        ; M40 first element of the route: canonical numbers
LF1     EQU 069H
SF1     EQU 0A9H        ; M41
LF2     EQU 06AH
SF2     EQU 0AAH        ; M42
LFR     EQU 06BH
SFR     EQU 0ABH        ; M43 its offset
LGX     EQU 06CH
SGX     EQU 0ACH        ; M44 where the route was entered
LGY     EQU 06DH
SGY     EQU 0ADH        ; M45
LKX     EQU 06EH
SKX     EQU 0AEH        ; M46 corner at the end of C
LKY     EQU 06FH
SKY     EQU 0AFH        ; M47
LPX     EQU 070H
SPX     EQU 0B0H        ; M48 last item, a point
LPY     EQU 071H
SPY     EQU 0B1H        ; M49
LQX     EQU 072H
SQX     EQU 0B2H        ; M50 first item, a point
LQY     EQU 073H
SQY     EQU 0B3H        ; M51
LJX     EQU 074H
SJX     EQU 0B4H        ; M52 J: point that arrives
LJY     EQU 075H
SJY     EQU 0B5H        ; M53
LMY     EQU 075H
SMY     EQU 0B5H        ; M53 too: joint of a biarc, seen from node 1: y
LFI     EQU 076H
SFI     EQU 0B6H        ; M54 fillet radius that waits
LSC     EQU 077H
SSC     EQU 0B7H        ; M55 scale
LVX     EQU 078H
SVX     EQU 0B8H        ; M56 end of the move, whole um
LVY     EQU 079H
SVY     EQU 0B9H        ; M57
LO1     EQU 078H
SO1     EQU 0B8H        ; M56 too: offset of C in a crossing
LO2     EQU 079H
SO2     EQU 0B9H        ; M57 too: offset of N in a crossing
LBX     EQU 07AH
SBX     EQU 0BAH        ; M58 block: x
LBY     EQU 07BH
SBY     EQU 0BBH        ; M59 block: y
LDX     EQU 07AH
SDX     EQU 0BAH        ; M58, M59 too: where the contour enters C as drawn, up to the block that C makes
LDY     EQU 07BH
SDY     EQU 0BBH
LBJ     EQU 07CH
SBJ     EQU 0BCH        ; M60 block: J
LQO     EQU 07DH
SQO     EQU 0BDH        ; M61 offset of the first item
LTL     EQU 07EH
STL     EQU 0BEH        ; M62 how far curves may cross and still be taken as touching, mm
; M63 is free

; ---- RAM -------------------------------------------------------------------
;! FSTK & 0FFH == 0 -- CALINI, CALC and OOVR change the low byte of FSP alone
;! CWORK >= FSTK+80 and FWORK >= CWORK+45 and MWORK >= FWORK+48 and KEPT >= MWORK+25 -- no cells overlap
;! MREG & 0FFH == 0 -- CALC makes a register's address from its number
;! MA/100H == (MA+5)/100H -- QUAD changes the low byte alone
;! MNODE1/100H == MNODE2/100H -- TRY changes the low byte alone
;! LINBUF & 0FFH == 80H and TOKS == LINBUF+80H -- GETLIN sees by C that the line is full, or empty; ERR counts blanks
;! TOKS & 0FFH == 0 -- LEX and STORE take a token's low address for its distance from the line's start
;! TOKS+100H == STKLOW -- GETLIN refuses tokens that leave their page; a record's length is a byte
;! GSTKE & 0FFH == 0 and GSTKE/100H == PROG/100H -- SRETN looks for the end; CLRPTR changes the low byte alone
;! HELD & 0FFH == 0 and HELD+16*PLCSIZ < PROG-1 -- HELDN is a low byte; CLOSED and RBFULL lie in front of PROG
;! KEPT+25 == MNODE1 and MNODE1+25 == MNODE2 -- ROTATE and SWAP exchange neighbours
FSTK    EQU RAM         ; float stack of the calculator, 16 floats, within a page
CWORK   EQU RAM+0050H   ; cells of parser, geom, route and tape (45 bytes)
FWORK   EQU RAM+0080H   ; work cells of float.asm and calc.asm (48 bytes); FSQR counts on the 80H
MWORK   EQU RAM+00B0H   ; cells of monitor, lexer and io (55 bytes)
KEPT    EQU RAM+00E7H   ; the node of FIT that was kept last, in front of node 1
MREG    EQU RAM+0100H   ; 64 float registers of the calculator, 5 bytes each, from a page's start
LINBUF  EQU RAM+0280H   ; the line being typed, 126 characters; reaches up to TOKS
TOKS    EQU RAM+0300H   ; the same line as tokens, a page
STKLOW  EQU RAM+0400H   ; the stack may not grow below this
STKTOP  EQU RAM+05F0H+BDSTK ; 8080 stack, downwards
HELD    EQU RAM+0600H+BDSTK ; in front of it GOSUB's stack; places of the nodes that FIT has passed, 16
PROG    EQU RAM+06A2H+BDSTK ; program lines from here up; variables from the top of RAM down

; ---- Cells that several files know --------------------------------------------
TXTP    EQU     MWORK           ; next token
PEND    EQU     MWORK+2         ; end of the program
VBOT    EQU     MWORK+4         ; lowest byte of the variables
VTOP    EQU     MWORK+6         ; last byte of RAM
NXTP    EQU     MWORK+8         ; the line to run next; high byte 0: the line is a direct one
CHKF    EQU     MWORK+10        ; 0: statements work; 1: they are only parsed; 2: after an error
OUTSEL  EQU     MWORK+11        ; 0: nothing is printed; 1: paper and punch; else paper
COLS    EQU     MWORK+12        ; characters printed; STORE looks at it
LASTC   EQU     MWORK+13        ; last character printed
KEYB    EQU     MWORK+14        ; key typed ahead
LOADF   EQU     MWORK+15        ; 1: lines come from the reader (OUTSEL to VSUM are walked through)
VSUM    EQU     MWORK+16        ; check sum of the variables, as of the last prompt
CURLIN  EQU     MWORK+17        ; number of the line that runs
DATP    EQU     MWORK+19        ; in front of the next DATA item: its comma, or a line's 00 (or PROG-2: CLOSED, no comma)
GSP     EQU     MWORK+21        ; top of the GOSUB stack
GSTK    EQU     HELD-16         ; 8 lines to go back to, downwards
GSTKE   EQU     HELD
LINUM   EQU     TOKS+4          ; number of the typed line, behind the length of its record
STMT0   EQU     TOKS+6          ; its statement, behind the number token
LEXAT   EQU     MWORK+23        ; -> text of the token that LEX makes; high byte 0: none is being made
VKIND   EQU CWORK       ; kind of the value in a0 a1 a2; CHKRET writes the cell behind it too
CLOSED  EQU PROG-2      ; not 0 = RECUT may come: the buffer holds a route that is cut
RBFULL  EQU PROG-1      ; not 0 = the route has outgrown its buffer
RBEND   EQU CWORK+43    ; end of the route buffer, which begins behind PEND
RMOVED  EQU MHX+20      ; not 0 = wire positioned or moved since RUN
BLKNO   EQU MHX+21      ; number of the last block, four decimal digits
