; equ.asm - names for every port, character, token, error and RAM cell of SKG
; Offers: equates only. Bytes: 0.

; ---- Board options (the build sets them in the top file) -----------------
;   BRD51   1 = two Intel 8251, 0 = two Motorola 6850
;   PTTY    1 = the punch is the teletype's own (DC2 ... DC4)

; ---- Characters -----------------------------------------------------------
CNUL    EQU 00H
CCTLC   EQU 03H         ; break
CBS     EQU 08H
CTAB    EQU 09H
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
ETAPE   EQU 10          ; block does not fit, reader ran out, operator broke in

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
TINT    EQU 02H         ; one byte follows: whole number 0...255
; 80H...B7H: a name; letter index * 4 + subscript high bits, then subscript low byte
TNAME   EQU 80H
; C0H...CDH: letter index of a name whose subscript is computed: tokens of an
; expression follow, then "]"
TSUB    EQU 0C0H
; letter indices: A D R I J (numbers) P O V (points) C B T (circles) S X Y (lines)
; words: functions first, then statements, then commands
TSQR    EQU 0D0H
TSIN    EQU 0D1H
TCOS    EQU 0D2H
TTG     EQU 0D3H
TATG    EQU 0D4H
TABS    EQU 0D5H
TINTF   EQU 0D6H        ; INT
TK1     EQU 0D7H
TK2     EQU 0D8H
TK3     EQU 0D9H
TFROM   EQU 0DAH
TCUT    EQU 0DBH
TBACK   EQU 0DCH
TEND    EQU 0DDH
TREM    EQU 0DEH
TPRINT  EQU 0DFH
TGOTO   EQU 0E0H
TIF     EQU 0E1H
TGOSUB  EQU 0E2H
TRETN   EQU 0E3H
TREAD   EQU 0E4H
TDATA   EQU 0E5H
TREST   EQU 0E6H        ; RESTORE
TINPUT  EQU 0E7H
TSCALE  EQU 0E8H
TSYM    EQU 0E9H
TREP    EQU 0EAH
TRECUT  EQU 0EBH
TFIT    EQU 0ECH
TRUN    EQU 0EDH        ; from here on: commands, not kept in a program
TLIST   EQU 0EEH
TNEW    EQU 0EFH
TLOAD   EQU 0F0H
TSAVE   EQU 0F1H
TFREE   EQU 0F2H

; ---- RAM -------------------------------------------------------------------
RAM     EQU 2000H
MREG    EQU RAM         ; 64 float registers of the calculator, 5 bytes each
FSTK    EQU 2140H       ; float stack of the calculator, 12 floats
FWORK   EQU 2180H       ; work cells of float.asm and calc.asm (48 bytes)
MWORK   EQU 21B0H       ; cells of monitor, lexer and io (80 bytes)
CWORK   EQU 2200H       ; cells of parser, geom, cut and tape (128 bytes)
LINBUF  EQU 2280H       ; the line being typed: LINMAX characters and CR
LINMAX  EQU 100
TOKBUF  EQU 22E8H       ; the same line as tokens
TOKMAX  EQU 200
STKLOW  EQU 23B0H       ; the stack may not grow below this
STKTOP  EQU 2600H       ; 8080 stack, downwards
PROG    EQU 2600H       ; program lines from here up; variables from the top of RAM down
