; equ.asm - names for every port, character, token, error and RAM cell of SKG
; Offers: equates only. Bytes: 0.

; ---- Board options (the build sets them in the top file) -----------------
;   BRD51   1 = two Intel 8251, 0 = two Motorola 6850
;   PTTY    1 = the punch is the teletype's own (DC2 ... DC4)
;   NODRIFT 1 = each block starts where the controller really stands (docs/drift.md)

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
CLPAR   EQU 28H         ; (
CRPAR   EQU 29H         ; )
CCOMMA  EQU 2CH         ; ,
CMINUS  EQU 2DH         ; -
CSEMI   EQU 3BH         ; ;
CEQU    EQU 3DH         ; =
CRBRK   EQU 5DH         ; ]
CZERO   EQU 30H
CLTB    EQU 42H         ; letters on the tape
CLTD    EQU 44H
CLTG    EQU 47H
CLTL    EQU 4CH
CLTN    EQU 4EH
CLTR    EQU 52H
CLTS    EQU 53H
CLTX    EQU 58H

; ---- Restarts -------------------------------------------------------------
;   RST 1 / DB n    ERROR   statement ends with ERR n
;   RST 2           PUTC    A to the paper (and the punch when it is on)
;   RST 3           NEXT    A = next token, token pointer past it
;   RST 4 / DB t    EXPECT  next token must be t, else ERR 01
;   RST 5 / DB ...  CALC    byte-code follows, up to kEND
;   RST 6           PEEK    A = next token, pointer stays

; ---- Errors (language.md section 6) ----------------------------------------
ESYN    EQU 1           ; not understood
ELINE   EQU 2           ; no such line, RETURN without GOSUB
EUNSET  EQU 3           ; name without a value
EKIND   EQU 4           ; kinds cannot be combined
ERANGE  EQU 5           ; number out of range
EGEOM   EQU 6           ; geometry impossible
EOFFS   EQU 7           ; wire offset larger than an inner radius
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
NAMER   EQU 8800H       ; the name R, the wire offset
; C0H...CDH: letter index of a name whose subscript is computed: tokens of an
; expression follow, then "]"
TSUB    EQU 0C0H
; letter indices: A D R I J (numbers) P O V (points) C B T (circles) S X Y (lines)
; words: functions first, then statements, then commands; the letters, which end KEYTAB,
; come to the end of a byte
TSQR    EQU 0CFH
TSIN    EQU 0D0H
TCOS    EQU 0D1H
TTG     EQU 0D2H
TATG    EQU 0D3H
TABS    EQU 0D4H
TINTF   EQU 0D5H        ; INT
TK1     EQU 0D6H
TK2     EQU 0D7H
TK3     EQU 0D8H
TFROM   EQU 0D9H
TCUT    EQU 0DAH
TBACK   EQU 0DBH
TEND    EQU 0DCH
TREM    EQU 0DDH
TPRINT  EQU 0DEH
TGOTO   EQU 0DFH
TIF     EQU 0E0H
TGOSUB  EQU 0E1H
TRETN   EQU 0E2H
TREAD   EQU 0E3H
TDATA   EQU 0E4H
TREST   EQU 0E5H        ; RESTORE
TINPUT  EQU 0E6H
TSCALE  EQU 0E7H
TSYM    EQU 0E8H
TREP    EQU 0E9H
TRECUT  EQU 0EAH
TFIT    EQU 0EBH
TRUN    EQU 0ECH        ; from here on: commands, not kept in a program
TLIST   EQU 0EDH
TNEW    EQU 0EEH
TLOAD   EQU 0EFH
TSAVE   EQU 0F0H
TFREE   EQU 0F1H
TLETR   EQU 0F2H        ; ...0FFH: in KEYTAB, the letters of the names

; ---- Calculator registers M0...M63 -------------------------------------------
; Lxx pushes a register, Sxx pops into it: one byte of byte-code each.
MA      EQU RAM         ; address of a0: value, and left operand
MB      EQU RAM+15      ; address of b0: right operand
MT0     EQU RAM+30      ; temporary registers
MCUR    EQU RAM+59      ; elements: kind, three numbers, offset; behind C and F the place of entry
MNEXT   EQU RAM+94
MFIRST  EQU RAM+139
MNODE1  EQU RAM+170     ; nodes of FIT: tangent, place
MNODE2  EQU RAM+295
ELSIZE  EQU 21          ; bytes of an element
LA0     EQU 040H
SA0     EQU 080H        ; M0
LA1     EQU 041H
SA1     EQU 081H        ; M1
LA2     EQU 042H
SA2     EQU 082H        ; M2
LB0     EQU 043H
SB0     EQU 083H        ; M3
LB1     EQU 044H
SB1     EQU 084H        ; M4
LB2     EQU 045H
SB2     EQU 085H        ; M5
LT0     EQU 046H
ST0     EQU 086H        ; M6
LT1     EQU 047H
ST1     EQU 087H        ; M7
LT2     EQU 048H
ST2     EQU 088H        ; M8
LT3     EQU 049H
ST3     EQU 089H        ; M9
LT4     EQU 04AH
ST4     EQU 08AH        ; M10
LC0     EQU 04CH
SC0     EQU 08CH        ; M12 current element: canonical numbers
LC1     EQU 04DH
SC1     EQU 08DH        ; M13
LC2     EQU 04EH
SC2     EQU 08EH        ; M14
LCR     EQU 04FH
SCR     EQU 08FH        ; M15 its wire offset
LAX     EQU 050H
SAX     EQU 090H        ; M16 where the wire entered C
LAY     EQU 051H
SAY     EQU 091H        ; M17
LN0     EQU 053H
SN0     EQU 093H        ; M19 next element: canonical numbers
LN1     EQU 054H
SN1     EQU 094H        ; M20
LN2     EQU 055H
SN2     EQU 095H        ; M21
LNR     EQU 056H
SNR     EQU 096H        ; M22 its wire offset
LHX     EQU 057H
SHX     EQU 097H        ; M23 start hole: the FROM point
LHY     EQU 058H
SHY     EQU 098H        ; M24
LWX     EQU 059H
SWX     EQU 099H        ; M25 wire, whole um
LWY     EQU 05AH
SWY     EQU 09AH        ; M26
LF0     EQU 05CH
SF0     EQU 09CH        ; M28 first element of the route: canonical numbers
LF1     EQU 05DH
SF1     EQU 09DH        ; M29
LF2     EQU 05EH
SF2     EQU 09EH        ; M30
LFR     EQU 05FH
SFR     EQU 09FH        ; M31 its wire offset
LGX     EQU 060H
SGX     EQU 0A0H        ; M32 where the route was entered
LGY     EQU 061H
SGY     EQU 0A1H        ; M33
L1U     EQU 062H
S1U     EQU 0A2H        ; M34 node 1 of FIT: unit tangent, 0 0 when not known
L1V     EQU 063H
S1V     EQU 0A3H        ; M35
L1X     EQU 064H
S1X     EQU 0A4H        ; M36 and place
L1Y     EQU 065H
S1Y     EQU 0A5H        ; M37
LKX     EQU 066H
SKX     EQU 0A6H        ; M38 corner at the end of C
LKY     EQU 067H
SKY     EQU 0A7H        ; M39
LPX     EQU 068H
SPX     EQU 0A8H        ; M40 last item, a point
LPY     EQU 069H
SPY     EQU 0A9H        ; M41
LQX     EQU 06AH
SQX     EQU 0AAH        ; M42 first item, a point
LQY     EQU 06BH
SQY     EQU 0ABH        ; M43
LDX     EQU 06CH
SDX     EQU 0ACH        ; M44 point that arrives
LDY     EQU 06DH
SDY     EQU 0ADH        ; M45
LFI     EQU 06EH
SFI     EQU 0AEH        ; M46 fillet radius that waits
LO1     EQU 06FH
SO1     EQU 0AFH        ; M47 offset of C in a crossing
LO2     EQU 070H
SO2     EQU 0B0H        ; M48 offset of N in a crossing
LSC     EQU 071H
SSC     EQU 0B1H        ; M49 scale
LT5     EQU 072H
ST5     EQU 0B2H        ; M50
LRT     EQU 073H
SRT     EQU 0B3H        ; M51 what SYM and REP do to items, how many times
LVX     EQU 074H
SVX     EQU 0B4H        ; M52 end of the move, whole um
LVY     EQU 075H
SVY     EQU 0B5H        ; M53
LBX     EQU 076H
SBX     EQU 0B6H        ; M54 block: x
LBY     EQU 077H
SBY     EQU 0B7H        ; M55 block: y
LBJ     EQU 078H
SBJ     EQU 0B8H        ; M56 block: J
LQR     EQU 079H
SQR     EQU 0B9H        ; M57 wire offset of the first item
LTL     EQU 07AH
STL     EQU 0BAH        ; M58 how far curves may cross and still be taken as touching, mm
L2U     EQU 07BH
S2U     EQU 0BBH        ; M59 node 2 of FIT: as node 1
L2V     EQU 07CH
S2V     EQU 0BCH        ; M60
L2X     EQU 07DH
S2X     EQU 0BDH        ; M61
L2Y     EQU 07EH
S2Y     EQU 0BEH        ; M62
L2R     EQU 07FH
S2R     EQU 0BFH        ; M63 and wire offset
LRA     EQU 07DH        ; M61, M62, M63 too: what SYM and REP do to items (they end a curve first)
SRA     EQU 0BDH
LRX     EQU 07EH
SRX     EQU 0BEH
LRY     EQU 07FH
SRY     EQU 0BFH
MKX     EQU RAM+190
MNR     EQU RAM+110
MHX     EQU RAM+115
MO1     EQU RAM+235
MBX     EQU RAM+270
MC2     EQU RAM+70

; ---- RAM -------------------------------------------------------------------
RAM     EQU 2000H
MREG    EQU RAM         ; 64 float registers of the calculator, 5 bytes each
FSTK    EQU 2140H       ; float stack of the calculator, 12 floats
FWORK   EQU 2180H       ; work cells of float.asm and calc.asm (48 bytes)
MWORK   EQU 21B0H       ; cells of monitor, lexer and io (80 bytes)
CWORK   EQU 2200H       ; cells of parser, geom, cut and tape (128 bytes)
LINBUF  EQU 2280H       ; the line being typed, 126 characters; reaches up to TOKS
TOKS    EQU 2300H       ; the same line as tokens, at a page's start
TOKROM  EQU 176         ; how many bytes of them
STKLOW  EQU 23B0H       ; the stack may not grow below this
STKTOP  EQU 2600H       ; 8080 stack, downwards
PROG    EQU 2600H       ; program lines from here up; variables from the top of RAM down
