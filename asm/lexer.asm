; lexer.asm - a line: typed, made tokens of, listed
; Offers: GETLIN LEX LISTLN PRNUM PRNUMC BLANK
; Uses:   [more] [ports] [punch] decimal io monitor start value
; Room:   460 bytes
;
;! (WAIT2 & 7FFH) == WAITMN -- ENDLIN waits so many turns as were counted from WAIT2 on, and WAITMN
;! (LINBUF/100H & 1) == 0 and (TOKS/100H & 1) == 1 -- GETL6 knows by B's lowest bit that the line has lost a character
;
; The tokens are in equ.asm, the words and theirs in words.asm.  Words come before names; a character that begins
; neither a word nor a name nor a number stands for itself, and the parser refuses
; what it does not know.  TOKS begins a page, so that the low byte of a token's address is
; its distance from the line's start; what is longer than the page is refused after LEX, the
; stack having room for what the longest line can make.

WAITMN  EQU     200             ; turns that ENDLIN waits at the least
WAIT2   EQU     4800H+WAITMN    ; from here to 8000H: two for each turn of INCH1 in two seconds (200 to 300 us each)

; GETLIN - reads a line into LINBUF, 00 behind it, and makes tokens of it; from then on
;          nothing is printed (OUTSEL = 0).  A control character that is no editing key
;          means nothing
; Out: TXTP-> the first token, DE-> behind the last; ERR 09 when the line is too long,
;      ERR 01, ERR 05; to READY at the end of the tape   Clobbers all
GETL1:  CALL    CRLF            ; ctrl-U: again
GETL2:  POP     H
GETLIN: LXI     B,LINBUF
GETL3:  LXI     H,GETL3         ; every key returns there
        PUSH    H
        LXI     D,WAIT2         ; waits for the next character, from the reader for a line of LOAD,
INCH1:  CALL    LISTEN          ; else (INPUT's answers too) from the teletype
        INX     H               ; LOADF, behind KEYB
        LDA     CHKF            ; (1 at the prompt, 0 in INPUT)
        ANA     M
        DCX     H
        MOV     A,M             ; the key
        INX     D               ; (for ENDLIN, whose turns are shorter)
        INX     D
        JZ      INCH2
        MOV     A,D
        ORA     A
        JM      GETL5           ; the reader has stopped
        CALL    BDREAD
        CPI     CEOF            ; a tape's; of the teletype's keys it is none
        JZ      GETL5
INCH2:  ORA     A               ; (HL-> KEYB, from LISTEN)
        JZ      INCH1
        MVI     M,0             ; (in LOAD keys do not count)
        JM      GETL7
        CPI     CCR             ; (HL-> KEYB for every key)
        JZ      GETL6
        CPI     CLF
        JZ      GETL6
        CPI     CCTLU
        JZ      GETL1
        CPI     CRUB
        JZ      GETL4
        CPI     CBS
        JZ      GETL4
        CPI     CBLANK
        RC
        STAX    B
        INR     C               ; (LINBUF ends with a page)
        JNZ     PUTC0
        DCR     C               ; full: stays, so that the line is refused
        RET
GETL4:  INX     H               ; take one back; a tape's RUBOUTs mean nothing
        MOV     A,M             ; LOADF
        ORA     A
        RNZ
        DCR     C
        JP      GETL2           ; (LINBUF begins at 80H of its page) none was there
        CALL    PUTSI
        DB      CBS,CBLANK,CBS+80H
        RET
GETL5:  MOV     A,C             ; the tape ends: at a line's start?
        ADD     A
        JNZ     ERTAPE
        CALL    BDOFF
        JMP     READY
GETL7:  STAX    B               ; a character is lost: the line ends here, the rest goes to TOKS
        MVI     B,TOKS/256
        RET
GETL6:  POP     H
        CALL    ENDLIN
        XRA     A
        STAX    B
        STA     OUTSEL
        STA     LEXAT+1
        LXI     H,TOKS
        SHLD    TXTP
        MOV     A,B
        RRC                     ; is it TOKS/256?
        JC      ERLOST
        INR     C
        JZ      ERMEM
        CALL    LEX
        MOV     A,D
        CPI     STKLOW/256
        RC                      ; its tokens keep to their page
        DB      ERROR,EMEM

; LEX - makes tokens of the text in LINBUF, but no further than the token in front of
;       TXTP, when TXTP is not TOKS
; Out: DE-> behind the last token, HL-> behind its text; ERR 01, ERR 05   Clobbers all
;
;       00              its token; LEX is left (LEX3)
;       "               the text as it is, up to the next quote (LEXRAW)
;       digit, point    TFLT and a float (DECIN)
;       a word          its token; behind REM the rest of the line as it is; a function is none
;                       unless a blank or a parenthesis follows
;       a letter        a name, or TSUB and a bracket (LEXNAM)
;       else            the character itself
LEX:    LXI     H,LINBUF
        LXI     D,TOKS-1
LEX1:   INX     D
        LDA     TXTP
        DCR     A
        CMP     E
        RC                      ; TXTP reached
        LXI     B,LEX1          ; every token returns there
        PUSH    B
        CALL    LEXTOK
        SHLD    LEXAT
        STAX    D               ; (stays when no token comes of it: the parser refuses it)
        ORA     A
        JZ      LEX3            ; the end, and its token
        MOV     C,A
        CPI     CQUOTE
        JZ      LEXRAW
        CALL    DIGIT
        JC      DECIN
        CPI     (CPOINT-CZERO) & 255
        JZ      DECIN
        PUSH    D
        LXI     D,KEYTAB        ; a word or a name's letter?
        MVI     B,TSQR          ; B = its token
LEXW1:  PUSH    H
LEXW2:  CALL    LEXCH
        XCHG
        XRA     M
        XCHG
        ADD     A               ; zero: equal but for bit 7, which goes to CY
        JNZ     LEXW3
        INX     H
        INX     D
        JNC     LEXW2
        MOV     A,B
        CPI     TFROM
        JNC     LEXW5
        MOV     A,M             ; behind a function stands a blank or its parenthesis
        ANI     0FFH-(CLPAR-CBLANK) ; (no other character differs from a blank in this bit)
        CPI     CBLANK
        DCX     D               ; (for LEXW4)
        JNZ     LEXW3
LEXW5:  POP     PSW             ; yes: HL-> behind it
        POP     D
        MOV     A,B
        CPI     TLETR
        JNC     LEXNAM
        STAX    D
        CPI     TREM
        RNZ
        MOV     C,A             ; (no character)
        MOV     A,M
        CPI     CBLANK          ; LIST puts one blank after REM
        JZ      LEXRAW
        DCX     H
; (fall into LEXRAW)

; LEXRAW - the text behind HL goes as it is, up to the character C or the end
; In:  HL, DE -> last character and token, C   Out: HL behind the text, DE -> last token; at the end LEX is left
; Clobbers A
LEXRAW: INX     H
        INX     D
        MOV     A,M
        STAX    D
        CMP     C
        JZ      LEX2
        ORA     A
        JNZ     LEXRAW
LEX3:   POP     B               ; LEX is left
        STA     LEXAT+1         ; (A = 0)
        INX     D
LEX2:   INX     H
        RET

LEXW3:  POP     H
LEXW4:  LDAX    D               ; to the next word
        INX     D
        ORA     A
        JP      LEXW4
        INR     B               ; (the last one's token is 0FFH)
        JNZ     LEXW1
        POP     D
        INX     H               ; no: the character stands for itself
        RET

; LEXNAM - a name, or its letter and the bracket of a computed subscript
; In:  A = the letter's token, HL behind the letter, DE -> where the name goes
; Out: HL behind it, DE -> its last byte; ERR 05   Clobbers A, BC
LEXNAM: SUI     TLETR-TSUB
        MOV     B,A
        CALL    LEXCH
        CPI     CLBRK
        MOV     A,B
        JNZ     LEXNA1
        STAX    D
        INX     H
        RET
LEXNA1: PUSH    D
        CALL    LEXDEC          ; DE = subscript
        MOV     A,D
        ORA     A
        PUSH    H
        CP      SUBCHK
        POP     H
        MOV     A,B
        ADD     A
        ADD     A
        ADD     D
        SUI     (4*TSUB)&255    ; 4 times the letter's index, and the subscript's high bits
        ORI     TNAME           ; (no digits: D = 80H)
        MOV     B,E
        POP     D
        STAX    D
        INX     D
        MOV     A,B
        STAX    D
        RET

; LISTLN - prints a line
; In:  DE = its number, HL-> tokens   Out: HL-> behind their end   Clobbers all
LISTLN: CALL    LISTDE
        MVI     A,CBLANK
        DB      PUTC
; (fall into LISTOK)

; LISTOK - prints a line's tokens as text that LEX reads back into the same tokens
; In:  HL-> tokens   Out: HL-> behind their end   Clobbers all
LISTOK: MOV     A,M
        INX     H
        ORA     A
        JZ      CRLF
        LXI     D,LISTOK        ; every token returns there
        PUSH    D
        JM      LIST1
        CPI     TFLT
        JNZ     PUTC0           ; stands for itself
        MVI     B,9
; (fall into PRNUM)

; PRNUM - prints one of several floats
; In:  HL -> it, B = most significant digits (8 or 9)
; Out: HL -> behind it   Clobbers A, DE
PRNUM:  MVI     E,0
; PRNUMC - the same, times 10^E (as DECOUT has it)   Clobbers A, DE
PRNUMC: PUSH    B
        PUSH    H
        CALL    DECOUT
        POP     H
        POP     B
        LXI     D,5
        DAD     D
        RET

LIST1:  CPI     TSQR            ; (LISTOK goes on here: a word?)
        JC      LIST3
        MOV     B,A             ; a word
        CPI     TFROM
        JC      LIST2
        LDA     LASTC           ; GOTO behind something else: a blank between
        CPI     CBLANK
        CNZ     BLANK
LIST2:  CALL    PRWORD
        MOV     A,M
        ORA     A
        RZ                      ; no blank at the line's end
; (fall into BLANK)

; BLANK - prints a blank
; Clobbers A
BLANK:  MVI     A,CBLANK
        DB      PUTC
        RET
LIST3:  CPI     TSUB            ; (a name with an index?)
        JNC     LIST4
        MOV     D,A
        RRC
        RRC
        CALL    PRLET
        MOV     E,M
        INX     H
        MOV     A,D
        ANI     3
        MOV     D,A             ; DE = subscript
        ORA     E
        RZ                      ; P0 is P
; (fall into LISTDE)

; LISTDE - prints the number DE; the place for a break
; Clobbers all but HL
LISTDE: PUSH    H
        CALL    BREAK
        XCHG
        CALL    PRDEC
        POP     H
        RET
LIST4:  XRI     TSUB&15         ; (its low half is that of the letter's index plus 8)
        CALL    PRLET
        MVI     A,CLBRK
        DB      PUTC
        RET

; PRLET - prints the letter with index A (low half)
; PRWORD - prints the word with token B
; Clobbers A, B
PRLET:  ANI     0FH
        ADI     TLETR
        MOV     B,A
PRWORD: PUSH    H
        LXI     H,KEYEND-1      ; back to the last character of the word in front of it
PRWO1:  DCX     H
        MOV     A,M
        ORA     A
        JP      PRWO1
        INR     B
        JNZ     PRWO1
        INX     H
        CALL    PUTS
        POP     H
        RET
