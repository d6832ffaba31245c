; lexer.asm - text to tokens and back
; Offers: LEX LISTOK KEYTAB
; Uses:   float (DECIN DECOUT FTOI16), io (PUTS PRDEC CRLF), start (DIGIT ADDA)
; Room:   480 bytes
;
; The tokens are in equ.asm.  Words come before names; a character that begins
; neither a word nor a name nor a number stands for itself, and the parser refuses
; what it does not know.  Control characters are refused here (01H and 02H are tokens).
; TOKS begins a page and so the low byte of a token's address is its distance from the
; line's start; what is longer than TOKROM is refused after LEX, the stack having room
; for what the longest line can make.

; LEX - makes tokens of the text in LINBUF
; In:  TXTP = TOKS: all of it; higher: up to the token in front of TXTP (error mark)
; Out: DE-> behind the last token, HL-> behind its text; ERR 01, ERR 05
; Clobbers all
LEX:    LXI     H,LINBUF
        LXI     D,TOKS
LEX1:   LDA     TXTP
        DCR     A
        CMP     E
        RC                      ; TXTP reached
        CALL    LEXCH
LEX2:   STAX    D
        ORA     A
        JZ      LEX4            ; the end, and its token
        CPI     CBLANK
        JC      ERSYN
        CPI     CQUOTE
        MOV     C,A
        JZ      LEXRAW
        CPI     CDOT
        JZ      LEXNUM
        CPI     CCOLON
        JC      LEX5
        PUSH    D
        LXI     D,KEYTAB        ; a word?
        MVI     B,TSQR          ; B = its token
LEXW1:  PUSH    H
LEXW2:  CALL    LEXCH
        MOV     C,A
        LDAX    D
        ANI     7FH
        CMP     C
        JNZ     LEXW4
        INX     H
        LDAX    D
        INX     D
        ORA     A
        JP      LEXW2
        POP     PSW             ; yes: HL-> behind it
        POP     D
        MOV     A,B
        CPI     TREM
        JNZ     LEX7
        STAX    D
        MOV     A,M
        MVI     C,TEOL
        CPI     CBLANK          ; LIST puts one blank after REM
        JZ      LEXRAW
        DCX     H
; (fall into LEXRAW)

; LEXRAW - the text behind HL goes as it is, up to the character C
LEXRAW: INX     H
        INX     D
        MOV     A,M
        STAX    D
        CMP     C
        JZ      LEXRA1
        CPI     CBLANK
        JNC     LEXRAW
        JMP     ERSYN           ; a control character, no second quote
LEXRA1: ORA     A
        JNZ     LEX3
LEX4:   INX     D
        INX     H
        RET

LEXW4:  POP     H
LEXW5:  LDAX    D               ; to the next word
        INX     D
        ORA     A
        JP      LEXW5
        INR     B
        MOV     A,B
        CPI     TFREE+1
        JNZ     LEXW1
        POP     D
        LDAX    D               ; a name?
        PUSH    H
        LXI     H,LETTAB
        LXI     B,14*256+TSUB
LEXN1:  CMP     M
        JZ      LEXN2
        INX     H
        INR     C
        DCR     B
        JNZ     LEXN1
        POP     H
        JMP     LEX3
LEX5:   CALL    DIGIT
        JC      LEXNUM
LEX3:   INX     H               ; the character stands for itself
        INX     D
        JMP     LEX1

LEXN2:  POP     H
        INX     H
        CALL    LEXCH
        CPI     CLBRK
        MOV     A,C
        STAX    D               ; (should it be a computed subscript)
        JZ      LEX3
        PUSH    D
        LXI     D,0             ; DE = subscript
LEXN3:  CALL    LEXCH
        CALL    DIGIT
        JNC     LEXN4
        INX     H
        PUSH    H
        MOV     H,D
        MOV     L,E
        DAD     H
        DAD     H
        DAD     D
        DAD     H
        CALL    ADDA            ; 10 * subscript + digit
        XCHG
        LXI     H,-SUBMAX-1
        DAD     D
        POP     H
        JC      ERRNG
        JMP     LEXN3
LEXN4:  MOV     A,C             ; 0C0H + index
        ADD     A
        ADD     A
        ORI     TNAME
        ORA     D
        MOV     B,E
        POP     D
        STAX    D
        INX     D
        MOV     A,B
LEX7:   STAX    D
        INX     D
        JMP     LEX1

; LEXNUM - a number
LEXNUM: PUSH    D
        INX     D
        CALL    DECIN
        POP     D
        JC      LEX3            ; a dot alone
        PUSH    H
        PUSH    D
        XCHG
        INX     H
        CALL    FTOI16
        POP     D
        JC      LEXNU1
        MOV     A,H
        ORA     A
        JNZ     LEXNU1
        MVI     A,TINT          ; 0...255: two bytes
        STAX    D
        INX     D
        MOV     A,L
        POP     H
        JMP     LEX7
LEXNU1: MVI     A,TFLT
        STAX    D
        LXI     H,6
        DAD     D
        XCHG
        POP     H
        JMP     LEX1

; LEXCH - next character that counts
; In:  HL-> text   Out: A = it, in upper case; HL-> it   Clobbers nothing else
LEXC1:  INX     H
LEXCH:  MOV     A,M
        CPI     CBLANK
        JZ      LEXC1
        CPI     CLOWA
        RC
        CPI     CLOWZ+1
        RNC
        SUI     20H
        RET

; LISTOK - prints a line's tokens as text that LEX reads back into the same tokens
; In:  HL-> tokens   Out: HL-> behind their end   Clobbers all
LIST1:  RST     2
LISTOK: MOV     A,M
        INX     H
        ORA     A
        JZ      CRLF
        JM      LIST2
        CPI     TINT
        JZ      LISINT
        JNC     LIST1           ; stands for itself
        PUSH    H
        MVI     B,9
        CALL    DECOUT
        POP     H
        LXI     D,5
        DAD     D
        JMP     LISTOK
LISINT: MOV     E,M
        INX     H
        MVI     D,0
        JMP     LISDEC
LIST2:  PUSH    H
        CPI     TSQR
        JC      LISNAM
        MOV     B,A             ; a word
        CPI     TFROM
        JC      LISWD1
        LDA     LASTC           ; GOTO behind a name: a blank between
        CPI     CBLANK
        MVI     A,CBLANK
        JZ      LISWD1
        RST     2
LISWD1: LXI     H,KEYTAB
        MVI     A,TSQR
LISWD2: CMP     B
        JZ      LISWD4
        INR     A
        MOV     C,A
LISWD3: MOV     A,M             ; skip a word
        INX     H
        ORA     A
        JP      LISWD3
        MOV     A,C
        JMP     LISWD2
LISWD4: CALL    PUTS
        POP     H
        MOV     A,M
        ORA     A
        JZ      LISTOK          ; no blank at the line's end
        MVI     A,CBLANK
        JMP     LIST1

LISNAM: MOV     D,A
        CPI     TSUB
        JNC     LISSUB
        POP     H
        ANI     3
        MOV     E,M
        INX     H
        XCHG                    ; E = subscript, low part
        MOV     C,L
        MOV     L,H             ; first byte
        MOV     B,A
        MOV     A,L
        ANI     7FH
        RRC
        RRC
        CALL    LISLET
        XCHG
        MOV     D,B
        MOV     E,C
        MOV     A,D
        ORA     E
        JZ      LISTOK          ; P0 is P
LISDEC: PUSH    H
        XCHG
        CALL    PRDEC
        POP     H
        JMP     LISTOK
LISSUB: POP     H
        CALL    LISLET
        MVI     A,CLBRK
        JMP     LIST1

; LISLET - prints the letter with index A
LISLET: PUSH    H
        ANI     0FH
        LXI     H,LETTAB
        CALL    ADDA
        MOV     A,M
        RST     2
        POP     H
        RET

LETTAB: DB      "ADRIJPOVCBTSXY"

; The words in the order of their tokens, bit 7 set in the last character
KEYTAB: DB      "SQ",0D2H       ; SQR
        DB      "SI",0CEH       ; SIN
        DB      "CO",0D3H       ; COS
        DB      "T",0C7H        ; TG
        DB      "AT",0C7H       ; ATG
        DB      "AB",0D3H       ; ABS
        DB      "IN",0D4H       ; INT
        DB      "K",0B1H        ; K1
        DB      "K",0B2H        ; K2
        DB      "K",0B3H        ; K3
        DB      "FRO",0CDH      ; FROM
        DB      "CU",0D4H       ; CUT
        DB      "BAC",0CBH      ; BACK
        DB      "EN",0C4H       ; END
        DB      "RE",0CDH       ; REM
        DB      "PRIN",0D4H     ; PRINT
        DB      "GOT",0CFH      ; GOTO
        DB      "I",0C6H        ; IF
        DB      "GOSU",0C2H     ; GOSUB
        DB      "RETUR",0CEH    ; RETURN
        DB      "REA",0C4H      ; READ
        DB      "DAT",0C1H      ; DATA
        DB      "RESTOR",0C5H   ; RESTORE
        DB      "INPU",0D4H     ; INPUT
        DB      "SCAL",0C5H     ; SCALE
        DB      "SY",0CDH       ; SYM
        DB      "RE",0D0H       ; REP
        DB      "RECU",0D4H     ; RECUT
        DB      "FI",0D4H       ; FIT
        DB      "RU",0CEH       ; RUN
        DB      "LIS",0D4H      ; LIST
        DB      "NE",0D7H       ; NEW
        DB      "LOA",0C4H      ; LOAD
        DB      "SAV",0C5H      ; SAVE
        DB      "FRE",0C5H      ; FREE
