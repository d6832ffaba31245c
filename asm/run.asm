; run.asm - statements are carried out one after the other: RUN, END, GOTO, IF, GOSUB, RETURN; NEW, and how a run starts
; Offers: STMT SRETN SGOSUB SIF SGOTO SRUN DIRECT STEND SNEW NEWPRG CLEAR FRESH CLRPTR
; Uses:   [more] [post] [punch] calc data ends monitor parser program start
; Room:   259 bytes

;! STTEND-STTAB == 2*(TLETR-TFROM) -- an address for every word from FROM on
;! TLETR+14 == 100H -- the letters' tokens end with the byte

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

; SRETN - statement: RETURN
SRETN:  DB      CHKEND
        LHLD    GSP
        MOV     A,L
        ORA     A               ; (GSTKE begins a page)
        JZ      ERLINE
        CALL    LOADDE
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
        MOV     A,D
        ORA     E
        CNZ     TARGE1          ; (before anything is cleared)
        PUSH    D
        CALL    CLEAR
        POP     D
        CALL    FINDLN
        JC      END1            ; no program: no line that an error could name
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
        CALL    LETGO
DIRECT: LXI     SP,STKTOP       ; (CHKED comes in here with a line that has no number)
        LXI     H,0200H
        SHLD    CHKF            ; (nothing new to a line of the program)
        CALL    STMT
        JMP     RUNLP

; STEND - statement: END
STEND:  DB      CHKEND
END1:   CALL    ENDRT           ; (RUNLP comes in here at the end of the program, RUN where there is none)
        MVI     B,2             ; DD
        CALL    PUNDS
        JMP     READY

; SNEW - command: NEW
SNEW:   DB      CHKEND
; NEWPRG - forgets the program, variables and route
; Clobbers all
NEWPRG: LXI     H,PROG
        SHLD    PEND
        MVI     M,0
; (fall into CLEAR)

; CLEAR - forgets variables and route: the state in which a run starts
; Clobbers all
CLEAR:  LHLD    VTOP
        SHLD    VBOT
        MVI     M,0
; FRESH - the same, but the variables stay
; Clobbers all
FRESH:  CALL    RUNINI
; (fall into CLRPTR)

; CLRPTR - forgets what points into the program: DATA at its start, no GOSUB
; Clobbers A, HL
CLRPTR: LXI     H,GSTKE
        SHLD    GSP
        MVI     L,PROG & 255    ; (in one page: a test looks)
        JMP     SETDAT
