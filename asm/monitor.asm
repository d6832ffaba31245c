; monitor.asm - prompt, program lines, running them, errors
; Offers: READY RUNLP STMT ERR CHKED LINENO FINDLN CPHD NEW1 FREE1 CLEAR and the
;         statements and commands that do not cut; the cells below
; Uses:   everything
; Room:   600 bytes
;
; A program line: length of the record, line number (low byte first), tokens, 00, a byte
; that makes the sum of all 0 (checked at reset).  A zero length ends the program; PEND->
; it.

; ---- Cells -----------------------------------------------------------------
TXTP    EQU     MWORK           ; next token
PEND    EQU     MWORK+2         ; end of the program
VBOT    EQU     MWORK+4         ; lowest byte of the variables
VTOP    EQU     MWORK+6         ; last byte of RAM
NXTP    EQU     MWORK+8         ; the line to run next; high byte 0: the line is a direct one
CURLIN  EQU     MWORK+10        ; number of the line that runs
CHKF    EQU     MWORK+12        ; 0: statements work; 1: they are only parsed; 2: at the prompt
OUTSEL  EQU     MWORK+13        ; bit 0 paper, bit 1 punch; bit 2: INPUT waits for an answer
KEYB    EQU     MWORK+14        ; key typed ahead
LOADF   EQU     MWORK+15        ; 1: lines come from the reader
LASTC   EQU     MWORK+16        ; last character on the paper
LSTTO   EQU     MWORK+19        ; last line to list
DATP    EQU     MWORK+21        ; in front of the next DATA item: its comma, or a line's 00
INPNAM  EQU     MWORK+23        ; name that INPUT asks for
INPTXT  EQU     MWORK+25        ; TXTP while it does
VSUM    EQU     MWORK+17        ; check sum of the variables, as of the last prompt
GSP     EQU     MWORK+29        ; top of the GOSUB stack
GSTK    EQU     GSTKE-16        ; 8 lines to go back to, downwards
GSTKE   EQU     MWORK+55

LASTLN  EQU     9999            ; greatest line number
CPRMPT  EQU     3EH             ; >
CMARK   EQU     5EH             ; ^
CDOT    EQU     2EH
CLESS   EQU     3CH
CGT     EQU     3EH
CLBRK   EQU     5BH
CLOWA   EQU     61H             ; a

; ERR - prints the error, after what belongs before it, and goes to READY
; In:  A = number, the stack empty
ERR:    MOV     B,A
        LXI     H,OUTSEL
        MOV     A,M
        MVI     M,1
        ANI     4
        JZ      ERR1
        MOV     A,B
        CPI     EMEM
        JC      ASKAGN          ; a wrong answer
ERR1:   PUSH    B
        XRA     A
        STA     LOADF
        IF      PTTY
        MVI     A,CDC4          ; the teletype's punch and reader off
        RST     2
        MVI     A,CXOFF
        RST     2
        ENDIF
        LDA     LASTC
        CPI     CLF
        CNZ     CRLF
        LXI     H,CHKF
        MOV     A,M
        MVI     M,2             ; (an error while MARK works needs no mark)
        DCR     A
        CZ      MARK            ; while parsing: show the place
        CM      ROUTER          ; while working: the route ends
        CALL    PUTSI
        DB      "ERR",0A0H
        POP     PSW
        ORA     A
        DAA
        CALL    PUT2D
        LDA     NXTP+1
        ORA     A
        JZ      ERR2
        CALL    PUTSI
        DB      " LINE",0A0H
        LHLD    CURLIN
        CALL    PRDEC
ERR2:   CALL    CRLF
; (fall into READY)

; READY - the prompt: takes lines for ever
READY:  LXI     SP,STKTOP
        CALL    VARSUM
        XRA     A
        STA     NXTP+1
        LDA     LOADF
        XRI     1
        MOV     H,A
        MVI     L,2
        SHLD    CHKF            ; a tape's lines are not printed
        MVI     A,CPRMPT
        RST     2
        CALL    GETLIN
        LXI     H,1
        SHLD    CHKF            ; parse only, print nothing
        CALL    LEXALL
        LXI     H,-TOKS-TOKROM-1
        DAD     D
        JC      ERMEM
        PUSH    D               ; -> behind the tokens
        RST     6
        JZ      READY
        LXI     H,0
        CPI     TFLT
        JNZ     READ1           ; no number: a direct line
        CALL    LINENO
        PUSH    H
        DCX     H
        LXI     D,-LASTLN
        DAD     D
        POP     H
        JC      ERSYN
READ1:  PUSH    H               ; line number, 0: none
        RST     6
        PUSH    H               ; -> the statement
        CNZ     STMT
; (fall into CHKED)

; CHKED - the line is understood: stores it or carries it out
CHKED:  LXI     SP,STKTOP-6
        POP     H
        SHLD    TXTP
        POP     D
        MOV     A,D
        ORA     E
        JZ      DIRECT
; (fall into STORE)

; STORE - puts the line into the program, or takes it out
; In:  DE = its number, TXTP-> its tokens, on the stack: -> behind them
STORE:  POP     B
        RST     3
        CPI     TRUN
        JNC     ERSYN           ; commands do not go into a program
        DCX     H
        DCX     H
        MOV     M,D             ; the record's head takes the place of the number token
        DCX     H
        MOV     M,E
        DCX     H
        ORA     A
        JZ      STOR1           ; the number alone: no record
        MOV     A,C
        SUB     L
        MOV     B,A
        INR     A
        MOV     M,A
        PUSH    H
        CALL    SUMREC
        MOV     M,A
        POP     H
        MOV     A,M
STOR1:  MOV     M,A
        MOV     C,A             ; C = length
        PUSH    H
        CALL    FINDLN          ; HL-> its place
        MVI     A,0
        JNZ     STOR2
        MOV     A,M             ; A = length of the line that it replaces
STOR2:  PUSH    H
        MOV     D,H
        MOV     E,L
        CALL    ADDA
        XCHG                    ; DE-> the program behind it
        MOV     A,C
        CALL    ADDA            ; HL-> where that must go
        LDA     PEND
        SUB     E
        MOV     C,A
        LDA     PEND+1
        SBB     D
        MOV     B,A
        INX     B               ; BC = its length
        PUSH    D
        PUSH    H
        DAD     B
        DCX     H
        XCHG
        LHLD    VBOT
        XCHG
        CALL    CPHD
        JNC     ERMEM
        SHLD    PEND
        POP     H
        POP     D
        CALL    CPHD
        JC      STOR4
        DAD     B               ; move up: last byte first
        XCHG
        DAD     B
        XCHG
STOR3:  DCX     D
        DCX     H
        LDAX    D
        MOV     M,A
        DCX     B
        MOV     A,B
        ORA     C
        JNZ     STOR3
        JMP     STOR5
STOR4:  LDAX    D               ; move down
        MOV     M,A
        INX     D
        INX     H
        DCX     B
        MOV     A,B
        ORA     C
        JNZ     STOR4
STOR5:  POP     H
        POP     D
        LDAX    D
        ORA     A
        CNZ     COPY
        CALL    RTNEW           ; the route buffer began at PEND
        CALL    CLRPTR
        JMP     READY

; FINDLN - finds a line
; In:  DE = number
; Out: HL-> the first line with that number or a higher one; Z: it is that number;
;      CY: no such line, HL-> the end   Clobbers A
FINDLN: LXI     H,PROG
FIND1L: MOV     A,M
        SUI     1
        RC                      ; (Z clear)
        PUSH    H
        INX     H
        MOV     A,M
        INX     H
        MOV     H,M
        MOV     L,A
        CALL    CPHD
        POP     H
        RNC
        MOV     A,M
        CALL    ADDA
        JMP     FIND1L

; CPHD - compares
; In:  HL, DE   Out: flags of HL - DE: CY less, Z equal   Clobbers A
CPHD:   MOV     A,H
        CMP     D
        RNZ
        MOV     A,L
        CMP     E
        RET

; LINENO - takes a line number
; In:  TXTP   Out: HL = number, 0...65535; ERR 01   Clobbers all
LINENO: RST     4
        DB      TFLT
        CALL    OPFLT
        LXI     H,MA
        CALL    FTOI16
        RNC
        JMP     ERSYN

; OPTLN - takes a line number, if there is one, and demands the statement's end
; Out: DE = number, else 0   Clobbers all
OPTLN:  RST     6
        LXI     H,0
        JZ      LNEND1
; (fall into LNEND)

; LNEND - takes a line number and demands the statement's end
; Out: DE = number   Clobbers all
LNEND:  CALL    LINENO
LNEND1: PUSH    H
        RST     7
        POP     D
        RET

; SRETN - statement: RETURN
SRETN:  RST     7
        LHLD    GSP
        MOV     A,L
        CPI     GSTKE & 255
        JZ      ERLINE
        MOV     E,M
        INX     H
        MOV     D,M
        INX     H
        SHLD    GSP
        XCHG
        JMP     RUN1

; SGOSUB - statement: GOSUB n
SGOSUB: CALL    LNEND
        LHLD    NXTP
        PUSH    H
        LHLD    GSP
        MOV     A,L
        CPI     GSTK & 255
        JZ      ERLINE
        POP     B
        DCX     H
        MOV     M,B
        DCX     H
        MOV     M,C
        SHLD    GSP
        JMP     GOLINE

; SIF - statement: IF expression relation expression GOTO n
SIF:    CALL    EVNUM
        RST     5
        DB      LA0,QEND        ; left
        RST     3
        MOV     B,A             ; B, C = what makes it true
        MOV     C,A
        SUI     CLESS
        CPI     CGT-CLESS+1
        JNC     ERSYN
        DCR     A
        JZ      SIF2            ; =
        RST     6
        SUI     CEQU
        CPI     CGT-CEQU+1
        JNC     SIF2
        RST     3               ; <= >= <>
        MOV     C,A
SIF2:   PUSH    B
        CALL    EVNUM
        RST     5
        DB      LA0,QEND        ; left right
        RST     4
        DB      TGOTO
        CALL    LNEND
        PUSH    D
        RST     5
        DB      SB0,SA0,QEND    ; -
        CALL    CMPNE
        POP     D
        POP     B
        MVI     A,CEQU
        JZ      SIF3
        MVI     A,CLESS
        JC      SIF3
        MVI     A,CGT
SIF3:   CMP     B
        JZ      GOLINE
        CMP     C
        RNZ
        JMP     GOLINE

; SGOTO - statement: GOTO n
SGOTO:  CALL    LNEND
; (fall into GOLINE)

; GOLINE - goes on with a line
; In:  DE = its number; ERR 02
GOLINE: CALL    FINDLN
        JZ      RUN1
ERLINE: RST     1
        DB      ELINE

; SRUN - command: RUN, RUN n
SRUN:   CALL    OPTLN
        PUSH    D
        CALL    CLEAR
        POP     D
        INX     H
        INX     H               ; HL = PROG
        MOV     A,D
        ORA     E
        JNZ     GOLINE
RUN1:   SHLD    NXTP
; (fall into RUNLP)

; RUNLP - runs the program from NXTP on; to READY when a direct line is done
RUNLP:  LXI     SP,STKTOP
        LHLD    NXTP
        MOV     A,H
        ORA     A
        JZ      READY
        MOV     A,M
        ORA     A
        JZ      END1            ; past the last line
        PUSH    H
        CALL    ADDA
        SHLD    NXTP
        POP     H
        INX     H
        MOV     E,M
        INX     H
        MOV     D,M
        INX     H
        SHLD    TXTP
        XCHG
        SHLD    CURLIN
        CALL    BREAK
DIRECT: LXI     H,0100H
        SHLD    CHKF            ; (nothing new to a line of the program)
        CALL    STMT
        JMP     RUNLP

; STMT - one statement
; In:  TXTP   Clobbers all
STMT:   CALL    CALINI
        RST     6
        CPI     TFROM
        JC      ASSIGN
        RST     3
        SUI     TFROM
        LXI     H,STTAB
        JMP     JTAB

; The statements in the order of their tokens
STTAB:  DW      SFROM,SCUT,SBACK,SEND,SREM,SPRINT,SGOTO,SIF
        DW      SGOSUB,SRETN,SREAD,SDATA,SREST,SINPUT
        DW      SSCALE,SSYM,SREP,SRECUT,SFIT
        DW      SRUN,SLIST,SNEW,SLOAD,SSAVE,SFREE

; SEND - statement: END
SEND:   RST     7
END1:   CALL    CENDST
        JMP     READY

; SPRINT - statement: PRINT item, item ...
SPRINT: LXI     H,CRLF
        PUSH    H               ; comes last
        RST     6
        JZ      CHKEND
SPRI1:  RST     6
        CPI     CQUOTE
        JZ      SPRI3
        CALL    EVAL
        CALL    PRVAL
SPRI2:  CALL    MORE
        MVI     A,CBLANK
        RST     2
        JMP     SPRI1
SPRI3:  RST     3               ; the quote
SPRI4:  RST     3
        JZ      ERSYN           ; no second quote
        CPI     CQUOTE
        JZ      SPRI2
        RST     2
        JMP     SPRI4

; MORE - in a list: takes the comma; where there is none the statement must end, and
;        the routine that called is left
; Clobbers A, HL
MORE:   RST     6
        CPI     CCOMMA
        JZ      NEXT
        POP     H
        JMP     CHKEND

; SDATA - statement: DATA expression, ...: nothing, until READ comes
SDATA:  LDA     CHKF
        ORA     A
        RZ
SDAT1:  CALL    EVAL
        CALL    MORE
        JMP     SDAT1

; SREST - statement: RESTORE, RESTORE n
SREST:  CALL    OPTLN
        CALL    FINDLN
REST1:  DCX     H
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
        LHLD    DATP
        MOV     A,M
        CPI     CCOMMA
        JZ      READI3
        INX     H               ; the line that follows the 00 and the check byte
        INX     H
READI1: MOV     A,M
        ORA     A
        JZ      ERDATA
        MOV     D,H
        MOV     E,L
        CALL    ADDA
        INX     D
        INX     D
        INX     D
        LDAX    D
        CPI     TDATA
        JNZ     READI1
        XCHG
READI3: INX     H
        XCHG
        LHLD    TXTP
        PUSH    H
        XCHG
        SHLD    TXTP
        CALL    EVAL
        LHLD    TXTP
        SHLD    DATP
        POP     H
        SHLD    TXTP
        POP     D
        JMP     SETREF

; SINPUT - statement: INPUT name, ...; a direct one asks for one name, its line being
;          overwritten by the answer
SINPUT: CALL    GETREF
        CALL    ASK
SINP1:  LXI     H,NXTP+1
        LDA     CHKF
        ORA     M
        RZ
        CALL    MORE
        JMP     SINPUT

; ASKAGN - after a wrong answer: the stack is empty
ASKAGN: LXI     H,RUNLP
        PUSH    H
        LXI     H,SINP1
        PUSH    H
        JMP     ASK1

; ASK - asks for a value
; In:  DE = name   Clobbers all
ASK:    CALL    CHKRET
        XCHG
        SHLD    INPNAM
        LHLD    TXTP
        SHLD    INPTXT
ASK1:   MVI     A,5
        STA     OUTSEL
        CALL    PUTSI
        DB      "?",0A0H
        CALL    GETLIN
        CALL    LEXALL
        CALL    EVAL
        RST     4
        DB      TEOL
        LHLD    INPNAM
        XCHG
        CALL    SETREF
        MVI     A,1
        STA     OUTSEL
        LHLD    INPTXT
        SHLD    TXTP
        RET

; SLIST - command: LIST, LIST n, LIST n,m
SLIST:  LXI     H,-1
        SHLD    LSTTO
        RST     6
        LXI     H,0
        JZ      SLIS2
        CALL    LINENO
        SHLD    LSTTO           ; one number: that line
        PUSH    H
        RST     6
        JZ      SLIS1
        RST     4
        DB      CCOMMA
        CALL    LINENO
        SHLD    LSTTO
SLIS1:  POP     H
SLIS2:  CALL    LNEND1          ; DE = first
        CALL    FINDLN
SLIS3:  MOV     A,M
        ORA     A
        RZ
        INX     H
        MOV     E,M
        INX     H
        MOV     D,M
        INX     H
        LDA     LSTTO
        SUB     E
        LDA     LSTTO+1
        SBB     D
        RC
        PUSH    H
        CALL    BREAK
        XCHG
        CALL    PRDEC
        MVI     A,CBLANK
        RST     2
        POP     H
        CALL    LISTOK
        INX     H               ; check byte
        JMP     SLIS3

; SSAVE - command: SAVE, SAVE n, SAVE n,m; ctrl-Z tells LOAD where the tape ends
SSAVE:  LDA     CHKF
        ORA     A
        CZ      PUNON
        CALL    SLIST
        MVI     A,CEOF
        RST     2
        JMP     PUNOFF

; SNEW - command: NEW
SNEW:   RST     7
NEW1:   LXI     H,PROG
        SHLD    PEND
        MVI     M,0
; (fall into CLEAR)

; CLEAR - forgets variables and route: the state in which a run starts
; Out: HL = PROG-2   Clobbers all
CLEAR:  CALL    CLRVAR
CLEAR1: CALL    RUNINI
; (fall into CLRPTR)

; CLRPTR - forgets what points into the program: DATA at its start, no GOSUB
; Clobbers A, HL
CLRPTR: LXI     H,GSTKE
        SHLD    GSP
        LXI     H,PROG
        JMP     REST1

; SLOAD - command: LOAD; waits for the tape's first character, then lines come from it
SLOAD:  RST     7
        IF      PTTY
        MVI     A,CXON          ; the teletype's reader on
        RST     2
        ENDIF
SLOA1:  CALL    BREAK
        IF      PTTY
        ORA     A
        ELSE
        IN      PUNST
        ANI     RXRDY
        ENDIF
        JZ      SLOA1
        IF      BRD51+PTTY
        MVI     A,1
        ENDIF                   ; (RXRDY of the 6850 is 1)
        STA     LOADF
        RET

; SFREE - command: FREE
SFREE:  RST     7
FREE1:  LHLD    PEND
        XCHG
        LHLD    VBOT
        MOV     A,L
        SUB     E
        MOV     L,A
        MOV     A,H
        SBB     D
        MOV     H,A
        CALL    PRDEC
        JMP     CRLF

; MARK - prints the typed line again and a mark under the end of the token in front of TXTP
; Out: sign flag clear   Clobbers all
MARK:   LXI     H,LINBUF
        CALL    PUTS
        CALL    CRLF
        CALL    LEX
        MOV     A,L
        SUI     LINBUF & 255
        MOV     B,A
        MVI     A,CBLANK
MARK1:  DCR     B
        JZ      MARK2
        RST     2
        JMP     MARK1
MARK2:  MVI     A,CMARK
        RST     2
        JMP     CRLF
