; monitor.asm - the prompt and the errors: a line is taken, understood, stored or carried out
; Offers: ERR CRRDY READY CHKED ERLOST SFREE FREE
; Uses:   [more] [punch] [start] data decimal ends io lexer program run start
; Room:   233 bytes

;! CHKF == NXTP+2 and OUTSEL == CHKF+1 -- READY clears NXTP's high byte with CHKF; ERR and RESET take two cells at once
;! KEYB == LASTC+1 and LOADF == KEYB+1 and VSUM == LOADF+1 -- BREAK leaves HL -> KEYB; READY comes from VSUM

LASTLN  EQU     9999            ; greatest line number

; ERRLX - LEX has refused something.  That waits for its turn: the parser may refuse what stands in
;         front of it, else it comes to the character that LEX has left there.  Then LEX, when ERR
;         looks for the place of the mark, refuses it again, and its number is the error's
; In:  L = CHKF, B = error, the stack empty; it goes to READY or back to ERR
ERRLX:  DCR     L
        JNZ     ERRLX1
        MOV     A,L             ; as the line came in
        STA     LEXAT+1
        JMP     READY1
ERRLX1: PUSH    B               ; while ERR looked for the place: on there, with the error and the
        PUSH    PSW             ; sign (plus) that it keeps on the stack
        LHLD    LEXAT
        JMP     ERR2

; ERR - prints the error, after what belongs before it, and goes to READY
; In:  A = number (10 as 10H), the stack empty
;
;       error           while                           what comes of it
;       01 to 09        an answer to INPUT is read      it is asked for again (ASKAGN)
;       01, 05 of LEX   a line comes in                 it waits for its turn (ERRLX)
;       01 to 09        a line is parsed                the line, the mark, ERR nn
;       any             a statement works               D when a route is open; ERR nn, and LINE n
;                                                       when a program runs
;       10              the prompt or a tape waits      ERR 10
ERR:    MOV     B,A
        LHLD    CHKF            ; L = CHKF, H = OUTSEL
        CPI     ETAPE
        JNC     ERR1
        MOV     A,H
        ORA     L
        JZ      ASKAGN          ; a wrong answer
        LDA     LEXAT+1
        ORA     A
        JNZ     ERRLX
        DB      SKIP1           ; skips the DAD
ERR1:   DAD     H               ; (1 becomes 2: no mark)
ERR6:   MOV     C,L
        PUSH    B
        LXI     H,0202H         ; paper on; an error while the mark is made needs none
        SHLD    CHKF
        CALL    BDOFF
        DCR     C
        PUSH    PSW
        JNZ     ERR3
        LXI     H,LINBUF        ; while parsing: the line again, and a mark under the end
        CALL    PUTS            ; of the token in front of TXTP
        CALL    CRLF
        CALL    LEX
        DCR     L
ERR2:   DCR     L               ; (LINBUF begins at 80H of its page)
        CM      BLANK
        JM      ERR2
        MVI     A,CMARK
        DB      PUTC
ERR3:   LDA     LASTC
        CPI     CLF
        CNZ     CRLF
        POP     PSW
        CM      ROUTER          ; while working: the route ends
        CALL    PUTSI
        DB      "ERR",0A0H
        POP     PSW
        CALL    PUT2D
        LDA     NXTP+1
        ORA     A
        JZ      CRRDY
        CALL    PUTSI
        DB      " LINE",0A0H
        LHLD    CURLIN
ERR4:   CALL    PRDEC           ; FREE ends here too
; CRRDY - CR LF, and goes to READY (DEND of drive.asm ends here, too)
CRRDY:  CALL    CRLF
; (fall into READY)

; READY - the prompt: takes a line, for ever; it is parsed, then CHKED is the place
READY:  LXI     SP,STKTOP
        CALL    BDRDY
        DCX     H               ; from VSUM to LOADF
        MOV     A,M
        DCR     A
        STA     OUTSEL          ; a tape's lines are not printed
        LXI     H,0100H
        SHLD    NXTP+1          ; and CHKF: parse only
        MVI     A,CPRMPT
        DB      PUTC
        CALL    GETLIN
READY1: PUSH    D               ; -> behind the tokens
        DB      PEEK
        DCR     A               ; TFLT?
        JNZ     STMT            ; no number: a direct line
        CALL    LINENO
        SHLD    LINUM
        DCX     H
        LXI     D,-LASTLN
        DAD     D
        JNC     STMT
        DB      ERROR,ESYN

; CHKED - the line is understood: stores it or carries it out, and goes to READY
; In:  at STKTOP-2: -> behind its tokens; the stack holds little more
CHKED:  MVI     A,CLF           ; (what was parsed has printed nothing: the paper's line is new)
        STA     LASTC
        LXI     H,TOKS
        SHLD    TXTP
        MOV     A,M
        CPI     TINPUT          ; in a program only: the answer would take the line's place
        JZ      ERSYN
        DCR     A               ; TFLT?
        JNZ     DIRECT
        CALL    STORE
        CALL    RTNEW           ; the route buffer began at PEND
        CALL    CLRPTR
        JMP     READY

; ERLOST - the line has lost a character: it is printed up to there.  Error 10, goes to READY
; Out: as ERR while a line is parsed; in INPUT as ERR while a statement works
ERLOST: MVI     B,ETAPE
        LHLD    CHKF
        JMP     ERR6

; SFREE - command: FREE
SFREE:  DB      CHKEND
; FREE - prints the bytes left, and goes to READY
FREE:   LHLD    PEND
        XCHG
        LHLD    VBOT
        MOV     A,L
        SUB     E
        MOV     L,A
        MOV     A,H
        SBB     D
        MOV     H,A
        JMP     ERR4
