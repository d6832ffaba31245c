; monitor.asm - prompt, commands, running the program, errors, reset
; Offers: ERR ERR5 READY CHKED ERLOST SFREE FREE LNEND SRETN SGOSUB SIF SGOTO SRUN STEND SPRINT
;         SDATA SREST SREAD SINPUT SLIST SNEW NEW1 CLEAR CLEAR1
; Uses:   calc cpm cut decimal drive float hold io io_disk io_ended io_tty iso lexer nohold parser
;         program reset start tape value
; Room:   741 bytes

;! CHKF == NXTP+2 and OUTSEL == CHKF+1 -- READY clears NXTP's high byte with CHKF; ERR and RESET take two cells at once
;! COLS == OUTSEL+1 and LASTC == COLS+1 -- PUTC1 walks back from LASTC
;! KEYB == LASTC+1 and LOADF == KEYB+1 and VSUM == LOADF+1 -- BREAK leaves HL -> KEYB; READY comes from VSUM
;! LINUM == TOKS+4 and STMT0 == TOKS+6 -- the record's head lies over the number's token
;! STTEND-STTAB == 2*(TLETR-TFROM) -- an address for every word from FROM on
;! TLETR+14 == 100H -- the letters' tokens end with the byte

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
        JZ      ERR5
        CALL    PUTSI
        DB      " LINE",0A0H
        LHLD    CURLIN
ERR4:   CALL    PRDEC           ; FREE ends here too
ERR5:   CALL    CRLF            ; (DEND comes in here)
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
        JC      ERSYN
; (fall into STMT)

; STMT - one statement.  Its routine is entered with TXTP behind the word, and clobbers all, too; it comes to CHKEND
;        before it acts
; In:  TXTP   Clobbers all
STMT:   CALL    CALINI
        DB      PEEK
        JZ      CHKEN0          ; none at all
        CPI     TFROM
        JC      ASSIGN
        DB      NEXT
        ADD     A               ; (in a byte)
        LXI     H,STTAB-2*TFROM+256
        CALL    ADDA
        MOV     E,M
        INX     H
        MOV     D,M
        XCHG
        PCHL

; CHKED - the line is understood: stores it or carries it out, and goes to READY
; In:  at STKTOP-2: -> behind its tokens; the stack holds little more
CHKED:  LXI     H,TOKS
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

; LINENO - takes a line number
; In:  TXTP   Out: HL = number, 0...65535; ERR 01   Clobbers all
LINENO: DB      EXPECT,TFLT
        CALL    OPFLT
        LXI     H,MA
        CALL    FTOI16
        RNC
        DB      ERROR,ESYN

; OPTLN - takes a line number, if there is one, and demands the statement's end
; Out: DE = number, else 0   Clobbers all
OPTLN:  DB      PEEK
        LXI     H,0
        JZ      LNEND1
; (fall into LNEND)

; LNEND - takes a line number and demands the statement's end
; Out: DE = number   Clobbers all
LNEND:  CALL    LINENO
LNEND1: XCHG                    ; (OPTLN comes in here with HL = 0: no number)
        DB      CHKEND
        RET

; SRETN - statement: RETURN
SRETN:  DB      CHKEND
        LHLD    GSP
        MOV     A,L
        ORA     A               ; (GSTKE begins a page)
        JZ      ERLINE
        CALL    LINE1
        SHLD    GSP
        XCHG
        JMP     RUN1

; SGOSUB - statement: GOSUB n
SGOSUB: CALL    TARGET
        PUSH    H
        LHLD    NXTP
        XCHG
        LHLD    GSP
        MOV     A,L
        CPI     GSTK & 255
        JZ      ERLINE
        DCX     H
        MOV     M,D
        DCX     H
        MOV     M,E
        SHLD    GSP
        POP     H
        JMP     RUN1

; SIF - statement: IF expression relation expression GOTO n
SIF:    CALL    EVNUM
        DB      CALC,LA0,QEND   ; left
        DB      NEXT
        MOV     B,A             ; B, C = what makes it true
        MOV     C,A
        SUI     CLESS
        CPI     CGT-CLESS+1
        JNC     ERSYN
        DCR     A               ; behind = comes nothing, behind > but =,
        JP      SIF1
        MVI     A,2             ; behind < both = and >
SIF1:   MOV     D,A
        DB      PEEK
        SUI     CEQU
        CMP     D
        JNC     SIF2            ; (what else stands there EVNUM sees)
        DB      NEXT            ; <= >= <>
        MOV     C,A
SIF2:   PUSH    B
        CALL    EVNUM
        DB      EXPECT,TGOTO
        CALL    CHECK
        JNZ     SGOTO
        CALL    CMPNE           ; right with left
        POP     B
        MVI     A,CLESS/4
        RAL                     ; CY: right is less
        RLC                     ; < or > (Z stays)
        JNZ     SIF3
        INR     A               ; < becomes =
SIF3:   CMP     B
        JZ      SGOTO
        CMP     C
        RNZ
; (fall into SGOTO)

; SGOTO - statement: GOTO n
SGOTO:  CALL    TARGET
        JMP     RUN1

; TARGET - takes the number of a line to go to and demands the statement's end
; Out: HL-> the line; ERR 02   Clobbers all
TARGET: CALL    LNEND
; TARGE1 - the same for a number in DE (RUN comes in here)
; Out: as TARGET   Clobbers all
TARGE1: CALL    FINDLN
        RZ
ERLINE: DB      ERROR,ELINE

; SRUN - command: RUN, RUN n
SRUN:   CALL    OPTLN
        PUSH    D
        CALL    CLEAR
        POP     D
        INX     H
        INX     H               ; HL = PROG
        MOV     A,D
        ORA     E
        CNZ     TARGE1
RUN1:   SHLD    NXTP            ; (GOTO, GOSUB and RETURN come in here with the line to go on at)
; (fall into RUNLP)

; RUNLP - runs the program from NXTP on; goes to READY when a direct line is done
RUNLP:  LHLD    NXTP
        MOV     A,H
        ORA     A
        JZ      READY
        CALL    PLINE
        JC      END1            ; past the last line
        SHLD    TXTP
        CALL    ADDA
        SHLD    NXTP
        XCHG
        SHLD    CURLIN
        CALL    LISTEN
DIRECT: LXI     SP,STKTOP       ; (CHKED comes in here with a line that has no number)
        LXI     H,0200H
        SHLD    CHKF            ; (nothing new to a line of the program)
        CALL    STMT
        JMP     RUNLP

; STEND - statement: END
STEND:  DB      CHKEND
END1:   CALL    ENDRT           ; (RUNLP comes in here at the end of the program)
        MVI     B,2             ; DD
        CALL    PUNDS
        JMP     READY

; SPRINT - statement: PRINT item, item ...
SPRINT: LXI     H,CRLF
        PUSH    H               ; comes last
        DB      PEEK
        JZ      CHKEN0
SPRI1:  DB      PEEK
        CPI     CQUOTE
        JZ      SPRI3
        CALL    EVAL
        CALL    PRVAL
SPRI2:  CALL    MORE
        MVI     A,CBLANK
        DB      PUTC
        JMP     SPRI1
SPRI3:  DB      NEXT            ; the quote
SPRI4:  DB      NEXT
        JZ      ERSYN           ; no second quote
        CPI     CQUOTE
        JZ      SPRI2
        DB      PUTC
        JMP     SPRI4

; SDATA - statement: DATA expression, ...: nothing, until READ comes
SDATA:  CALL    CHECK
        RZ
SDAT1:  CALL    EVAL
        CALL    MORE
        JMP     SDAT1

; SREST - statement: RESTORE, RESTORE n
SREST:  CALL    OPTLN
        CALL    FINDLN
REST1:  DCX     H               ; (CLRPTR comes in here with the first line)
        DCX     H
        SHLD    DATP
        RET

; SREAD - statement: READ name, ...
SREAD:  CALL    GETREF
        CALL    READI
        CALL    MORE
        JMP     SREAD

; READI - gives a name the next DATA item
; In:  DE = name; ERR 08   Clobbers all
READI:  CALL    CHKRET
        PUSH    D
        DB      PEEK            ; HL = TXTP
        PUSH    H
        LHLD    DATP
        MOV     A,M
        CPI     CCOMMA
        JZ      READI2
        MVI     A,2             ; over the 00 and the check byte
READI1: CALL    ADDA
        CALL    PLINE
        JC      ERDATA
        MOV     B,A
        MOV     A,M
        CPI     TDATA
        MOV     A,B
        JNZ     READI1
READI2: CALL    NEXT1           ; TXTP = HL+1
        CALL    EVAL
        DB      PEEK
        SHLD    DATP
; (fall into READI3)

; READI3 - ends READI and ASK; the stack keeps what it holds for ASKAGN until all is well
; In:  on the stack: TXTP, name; a0 a1 a2, VKIND   Out: paper on   Clobbers all
READI3: POP     H
        POP     D
        PUSH    D
        PUSH    H
        SHLD    TXTP
        CALL    SETREF
        POP     H
        POP     H
        JMP     PAPON

; SINPUT - statement: INPUT name, ..., in a program only
SINPUT: CALL    GETREF
        CALL    ASK
        CALL    MORE
        JMP     SINPUT

; ASKAGN - after a wrong answer: what ASK needs is still on the stack
; Out: as ASK   Clobbers all
ASKAGN: LXI     SP,STKTOP-8     ; RUNLP's return address, SINPUT's, name, TXTP
        CALL    PAPON
        CALL    CALINI          ; (the wrong answer's floats)
        JMP     ASK1

; ASK - asks for a value; a wrong answer is known by OUTSEL = 0 (GETLIN) in a statement
;       that works
; In:  DE = name   Clobbers all
;
; The stack while the answer is read and worked out, for ASKAGN and READI3:
;
;       STKTOP-2        return address of STMT, in RUNLP
;       STKTOP-4        return address of ASK, in SINPUT
;       STKTOP-6        the name
;       STKTOP-8        TXTP, behind the name in INPUT's list
ASK:    CALL    CHKRET
        PUSH    D
        DB      PEEK            ; HL = TXTP
        PUSH    H
ASK1:   CALL    PUTSI
        DB      "?",0A0H
        CALL    GETLIN
        CALL    EVAL
        DB      CHKEND
        JMP     READI3

; SLIST - command: LIST, LIST n, LIST n,m
SLIST:  DB      PEEK
        LXI     H,-1            ; HL = last line to list
        LXI     D,0             ; DE = first
        JZ      SLIS2
        CALL    LINENO
        PUSH    H
        DB      PEEK
        POP     H
        PUSH    H               ; one number: that line
        JZ      SLIS1
        DB      EXPECT,CCOMMA
        CALL    LINENO
SLIS1:  POP     D
SLIS2:  PUSH    H
        DB      CHKEND
        CALL    FINDLN
SLIS3:  CALL    PLINE
        POP     B               ; last
        RC
        MOV     A,C
        SUB     E
        MOV     A,B
        SBB     D
        RC
        PUSH    B
        CALL    LISTLN
        INX     H               ; check byte
        JMP     SLIS3

; SNEW - command: NEW
SNEW:   DB      CHKEND
NEW1:   LXI     H,PROG          ; (reset comes in here)
        SHLD    PEND
        MVI     M,0
; (fall into CLEAR)

; CLEAR - forgets variables and route: the state in which a run starts
; Out: HL = PROG-2   Clobbers all
CLEAR:  LHLD    VTOP
        SHLD    VBOT
        MVI     M,0
; CLEAR1 - the same, but the variables stay
; Clobbers all
CLEAR1: CALL    RUNINI
; (fall into CLRPTR)

; CLRPTR - forgets what points into the program: DATA at its start, no GOSUB
; Clobbers A, HL
CLRPTR: LXI     H,GSTKE
        SHLD    GSP
        MVI     L,PROG & 255    ; (in one page: a test looks)
        JMP     REST1
