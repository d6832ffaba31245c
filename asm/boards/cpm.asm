; cpm.asm - the program of CP/M: start, command line, files, the way back
; Offers: BDINIT BDRDY SBYE SPUNCH SSAVE SDIR
; Uses:   [more] [ports] [punch] calc io monitor program run start
; Room:   677 bytes
;
; The jump at 0 leads to REBOOT while the program runs: there the BDOS goes after an error on a disk,
; when the operator has read what it says.

; BDINIT - start: page 0, cells, memory up to the BDOS, the lines that the command line asks for;
;          signs on and goes to READY
BDINIT: LXI     SP,STKTOP
        LHLD    CPBDOS+1
        MVI     L,0             ; VTOP ends a page
        DCX     H
        SHLD    VTOP
        MOV     A,H
        CPI     PROG/256+4
        JC      NOROOM
        CALL    CALINI
        LXI     H,CPZERO
        MVI     B,CPZEND-CPZERO
        XRA     A
BDIN1:  MOV     M,A
        INX     H
        DCR     B
        JNZ     BDIN1
        LHLD    CPWBT
        SHLD    WBVEC
        LXI     H,REBOOT
        SHLD    CPWBT
        MVI     C,FERMOD
        MVI     E,0FFH
        CALL    CPBDOS
        LXI     H,0FF00H
        SHLD    CHKF            ; no check mode, paper on
        CALL    NEWPRG
        CALL    BDOFF
        CALL    CMDLIN          ; A = 1 when there is a script
        MOV     H,A
        MVI     L,0
        SHLD    KEYB            ; and LOADF
        LXI     H,BDZERO
        SHLD    TXTP            ; (FREE is a statement that ends)
        CALL    PUTSI
        DB      CCR,CLF,"SKG",0A0H
        JMP     FREE
NOROOM: LXI     D,NOROTX
        MVI     C,9             ; prints up to the dollar
        CALL    CPBDOS
        JMP     0
NOROTX: DB      "SKG: too little memory$"

; CMDLIN - what the command line asks for, as lines for LOAD:
;               LOAD "first word"
;               PUNCH "the rest"        and back to CP/M at the end
;               RUN
;               BYE                     if there was a second word
; Out: A = 1, 0 when it is empty; SCRIPT, SCRP, BATCH   Clobbers all
CMDLIN: LXI     H,CPTAIL
        MOV     A,M
        INX     H
        PUSH    H
        CALL    ADDA
CMDL1:  MVI     M,0             ; blanks at its end do not count
        DCX     H
        MOV     A,M
        CPI     CBLANK
        JZ      CMDL1
        POP     H
        LXI     D,SCRIPT
        CALL    SKIPBL
        RZ
        LXI     D,SCRIPT
        LXI     B,CMLOAD
        CALL    CMTEXT
CMDL2:  STAX    D               ; (A = its first character)
        INX     D
        INX     H
        MOV     A,M
        CPI     CBLANK+1
        JNC     CMDL2
        LXI     B,CMQUOT
        CALL    CMTEXT
        CALL    SKIPBL
        STA     BATCH
        JZ      CMDL4
        LXI     B,CMPUN
        CALL    CMTEXT
CMDL3:  STAX    D
        INX     D
        INX     H
        MOV     A,M
        ORA     A
        JNZ     CMDL3
        LXI     B,CMQUOT
        CALL    CMTEXT
CMDL4:  LXI     B,CMRUN
        CALL    CMTEXT
        LDA     BATCH
        ORA     A
        LXI     B,CMBYE
        CNZ     CMTEXT
        XRA     A
        STAX    D
        LXI     H,SCRIPT
        SHLD    SCRP
        INR     A
        RET

CMLOAD: DB      "LOAD ",CQUOTE,0
CMQUOT: DB      CQUOTE,CCR,0
CMPUN:  DB      "PUNCH ",CQUOTE,0
CMRUN:  DB      "RUN",CCR,0
CMBYE:  DB      "BYE",CCR,0

; CMTEXT - copies a text that ends with 0
; In:  BC-> it, DE-> to   Out: A = the character at HL, DE behind   Clobbers BC
CMTEXT: LDAX    B
        ORA     A
        JZ      CMTE1
        STAX    D
        INX     B
        INX     D
        JMP     CMTEXT
CMTE1:  MOV     A,M
        RET

; SKIPBL - over blanks
; In:  HL-> text   Out: HL-> its first other character, A = it, Z: the end   Clobbers nothing else
SKIPB1: INX     H
SKIPBL: MOV     A,M
        CPI     CBLANK
        JZ      SKIPB1
        ORA     A
        RET

; BDRDY - what is done at the prompt: a tape is closed, a SAVE that was broken off is dropped; when the
;         command line has asked for a tape, an error ends the program and what SUBMIT had in mind
; In:  CHKF = 2 after an error   Out: HL-> VSUM; ERR 10   Clobbers all
BDRDY:  LDA     WMODE
        CPI     WSAVE
        CZ      WDROP
        LDA     WMODE
        CPI     WTAPE
        JNZ     BDRD1
        CALL    WCLOSE
        LDA     CHKF
        ORA     A
        JNZ     BDRD1           ; (the next run begins it anew)
        STA     PUNF
BDRD1:  XRA     A
        STA     WMODE
        LDA     CHKF
        RAR
        RAR                     ; CY: 2
        LXI     H,BATCH
        SBB     A
        ANA     M
        LXI     H,VSUM
        RZ
        XRA     A
        STA     BATCH           ; (an error on that disk ends at the prompt)
        LXI     H,SUBFIL
        LXI     D,WFCB
        CALL    FBLOCK
        MVI     C,FDEL
        CALL    CPBDOS
        JMP     BYE

SUBFIL: DB      1,"$$$     SUB" ; on A:, what is left of a SUBMIT

; SBYE - command: BYE
SBYE:   DB      CHKEND
BYE:    LHLD    WBVEC
        SHLD    CPWBT
        JMP     0

; REBOOT - the BDOS gives up after an error on a disk: goes to ERR, number 10
REBOOT: LXI     SP,STKTOP
        MVI     A,WLOST
        STA     WMODE
        STA     LASTC           ; (no LF: the paper's line goes on)
        STA     GAVEUP          ; (the disk may be out: none is looked at before one is wanted)
        DB      ERROR,ETAPE

; NEWFIL - takes the name of a file that is to be written, and demands the statement's end
; In, Out: as ONEFIL (io_disk.asm); ERR 10 when it would be its own $$$   Clobbers all
NEWFIL: CALL    ONEFIL
        LDA     FNAME+9
        CPI     CDOLLR
        RNZ
        DB      ERROR,ETAPE

; SPUNCH - command: PUNCH "NAME", PUNCH
SPUNCH: DB      PEEK
        JZ      SPUN1
        LXI     H,TAPTYP
        CALL    NEWFIL
        LXI     H,FNAME
        LXI     D,PNAME
        MVI     B,12
        CALL    FCOPY
        INR     B
        MOV     A,B
        STA     PUNF
        RET
SPUN1:  DB      CHKEND
        XRA     A
        STA     PUNF
        RET

; SSAVE - command: SAVE "NAME"
SSAVE:  LXI     H,TYPSKG
        CALL    NEWFIL
        MVI     A,WSAVE
        CALL    WOPEN
        MVI     A,OFILE
        STA     OUTSEL
        LXI     H,BDZERO        ; (LIST, to its end)
        SHLD    TXTP
        CALL    SLIST
        CALL    WCLOSE
        JMP     PAPON

; SDIR - command: DIR, DIR "NAME.TYP" with * and ? in it; looks at the disks anew
SDIR:   DB      PEEK
        JNZ     SDIR1
        LXI     H,TXALL         ; (its tokens: a text in quotes)
        SHLD    TXTP
SDIR1:  LXI     H,TYPALL
        CALL    FILE
        DB      CHKEND
        LDA     FNAME+1
        CPI     CBLANK
        JNZ     SDIR3
        LXI     H,FNAME+1       ; but a drive: all names
        MVI     B,8
SDIR2:  MVI     M,CQUEST
        INX     H
        DCR     B
        JNZ     SDIR2
SDIR3:  CALL    ANEW
        LXI     D,WBUF
        MVI     C,FDMA
        CALL    CPBDOS
        LXI     H,FNAME
        LXI     D,WFCB
        CALL    FBLOCK
        XRA     A
        STA     WPOS            ; names in the line
        MVI     C,FFIRST
SDIR4:  CALL    FCALL
        JZ      SDIR6
        DCR     A
        RRC
        RRC
        RRC
        ANI     60H
        LXI     H,WBUF+1
        CALL    ADDA            ; HL-> name
        PUSH    H
        LXI     D,9
        DAD     D
        MOV     A,M
        RLC
        POP     H
        JC      SDIR5           ; one of the system's
        LDA     WPOS
        ANI     3
        CNZ     DIRSEP
        MVI     B,8
        CALL    DIRPUT
        MVI     A,CBLANK
        DB      PUTC
        MVI     B,3
        CALL    DIRPUT
        LXI     H,WPOS
        INR     M
        MOV     A,M
        ANI     3
        JNZ     SDIR5
        MVI     M,4             ; (not 0, however many)
        CALL    CRLF
SDIR5:  CALL    BREAK
        LXI     D,WFCB
        MVI     C,FNEXT
        JMP     SDIR4
SDIR6:  LDA     WPOS
        ORA     A
        JNZ     SDIR7
        CALL    PUTSI
        DB      "NO FIL",0C5H   ; NO FILE
        JMP     CRLF
SDIR7:  ANI     3
        RZ
        JMP     CRLF

; DIRPUT - prints B characters at HL
; Out: HL behind   Clobbers A, B
DIRPUT: MOV     A,M
        DB      PUTC            ; (without bit 7, an attribute)
        INX     H
        DCR     B
        JNZ     DIRPUT
        RET

; DIRSEP - prints what stands between two names
; Clobbers A
DIRSEP: CALL    PUTSI
        DB      " :",0A0H
        RET

TXALL:  DB      CQUOTE,CQUOTE,0
TYPALL: DB      "???"
