; io_disk.asm - punch and reader are files of CP/M
; Offers: CQUEST CDOLLR FFIRST FNEXT FDEL FDMA FERMOD WTAPE WSAVE WLOST ANEW FCALL FILE ONEFIL
;         FBLOCK FCOPY WOPEN WDROP WCLOSE BDPUN BDREAD SLOAD TYPSKG PUNOFF PUNON BDOFF BDZERO
; Uses:   [ports] io start
; Room:   790 bytes
;
; A file is written under its name with the type $$$ and takes its own when it is whole: what was there
; before stays until then.  WMODE says what is written.  READY (BDRDY, cpm.asm) closes a tape, also after
; an error, and drops a SAVE that has been broken off.  A failure is ERR 10: WLOST then takes what is
; still punched in that run.

CCOLON  EQU     3AH
CSTAR   EQU     2AH
CQUEST  EQU     3FH
CDOLLR  EQU     24H
CAT     EQU     40H
CCURLY  EQU     7BH             ; behind z

CPM3    EQU     30H             ; its version, as FVERSN has it
FVERSN  EQU     12              ; functions of the BDOS: A = version
FALL    EQU     13              ; all drives as at a warm boot
FDRIVE  EQU     14              ; E is the present drive
FOPEN   EQU     15
FCLOSE  EQU     16
FFIRST  EQU     17              ; first entry of the directory that fits
FNEXT   EQU     18
FDEL    EQU     19
FREADR  EQU     20
FWRITE  EQU     21
FMAKE   EQU     22
FRENAM  EQU     23
FWHICH  EQU     25              ; A = the present drive
FDMA    EQU     26              ; DE -> record
FRODRV  EQU     29              ; HL = drives that are write-protected, a bit each
FERMOD  EQU     45              ; of CP/M 3: E = 0FFH: errors come back to the program

WTAPE   EQU     1               ; a tape, closed at the prompt
WSAVE   EQU     2               ; SAVE's program, dropped at the prompt
WLOST   EQU     0FFH            ; it could not be written

; ANEW - the BDOS forgets what it knows of the disks, as at a warm boot
; Clobbers all
ANEW:   MVI     C,FALL
        CALL    CPBDOS
        LDA     CPDRV           ; (the BDOS knows it no more when it gave up while it looked at another)
        ANI     0FH
        MOV     E,A
        MVI     C,FDRIVE
        CALL    CPBDOS
        XRA     A
        STA     GAVEUP
        RET

; OPEN - opens a file; first the BDOS forgets the disks, when it has given up an error on one
; In:  DE -> block   Out: as FCALL   Clobbers all
OPEN:   PUSH    D
        LDA     GAVEUP
        ORA     A
        CNZ     ANEW
        POP     D
        MVI     C,FOPEN
; (fall into FCALL)

; FCALL - calls the BDOS for a file
; In:  C = function, DE -> block   Out: Z: it has failed, A = 0 then   Clobbers all
FCALL:  CALL    CPBDOS
        INR     A               ; (0 to 3 and 0FFH)
        RET

; FIELD - takes a name, a type or the letter of a drive
; In:  TXTP, DE-> its room, B = bytes of that
; Out: A = what ends it: the quote, a point or a colon; DE, B = room left; ERR 01, ERR 10
; Clobbers C, HL
FIEL1:  DCR     B
        JM      ERTAPE          ; too long
        STAX    D
        INX     D
FIELD:  DB      NEXT
        JZ      ERSYN           ; no second quote
        CPI     CQUOTE
        RZ
        CPI     CPOINT
        RZ
        CPI     CCOLON
        RZ
        CPI     CLOWA
        JC      FIEL2
        CPI     CCURLY
        JNC     FIEL2
        ANI     5FH
FIEL2:  LXI     H,NOCHRS
        MVI     C,NOCEND-NOCHRS
FIEL3:  CMP     M
        JZ      ERTAPE
        INX     H
        DCR     C
        JNZ     FIEL3
        CPI     CSTAR
        JNZ     FIEL1
        MVI     A,CQUEST        ; * is as many ? as there is room
FIEL4:  DCR     B
        JM      FIEL5
        STAX    D
        INX     D
        JMP     FIEL4
FIEL5:  INR     B
        JMP     FIELD

NOCHRS: DB      " ,;=_<>[]"     ; characters that no name has
NOCEND:

; FILE - takes a file's name in quotes: NAME, NAME.TYP, with or without D: in front
; In:  TXTP, HL-> the type that it has when none is given
; Out: FNAME; ERR 01, ERR 10   Clobbers all
FILE:   PUSH    H
        DB      EXPECT,CQUOTE
        LXI     H,FNAME
        MVI     M,0             ; the present drive
        MVI     B,11
FILE1:  INX     H
        MVI     M,CBLANK
        DCR     B
        JNZ     FILE1
        LXI     D,FNAME+1
        MVI     B,8
        CALL    FIELD
        CPI     CCOLON
        JNZ     FILE2
        MOV     A,B             ; it was a drive: one letter
        CPI     7
        JNZ     ERTAPE
        DCX     D
        LDAX    D
        SUI     CAT+1
        CPI     16
        CC      DRIVE
        JNC     ERTAPE
        INR     A
        STA     FNAME
        MVI     A,CBLANK
        STAX    D
        INR     B
        CALL    FIELD
FILE2:  POP     H
        LXI     D,FNAME+9
        MVI     B,3
        CPI     CPOINT
        JNZ     FILE3
        CALL    FIELD
        CPI     CQUOTE
        RZ
        DB      ERROR,ETAPE
FILE3:  CPI     CQUOTE
        JNZ     ERTAPE
FILE4:  MOV     A,M             ; none is given
        STAX    D
        INX     H
        INX     D
        DCR     B
        JNZ     FILE4
        RET

; DRIVE - demands that there is a drive, before the BDOS tells the operator; of CP/M 3, whose BIOS is not
;         for programs, it comes back as an error (FERMOD)
; In:  A = 0 for A, ...   Out: A the same, CY set; ERR 10   Clobbers C, HL
DRIVE:  PUSH    D
        PUSH    B
        PUSH    PSW
        MVI     C,FVERSN
        CALL    CPBDOS
        CPI     CPM3
        JNC     DRIV1
        POP     B
        PUSH    B
        CALL    SELDSK
        PUSH    H
        MVI     C,FWHICH
        CALL    CPBDOS
        MOV     B,A             ; the BDOS relies on it
        CALL    SELDSK
        POP     H
        MOV     A,H
        ORA     L
        JZ      ERTAPE
DRIV1:  POP     PSW
        POP     B
        POP     D
        RET

; SELDSK - the BIOS looks for a drive
; In:  B = 0 for A, ...   Out: HL = 0: there is none   Clobbers all
SELDSK: MOV     C,B
        MVI     E,1             ; (no new disk)
        LHLD    WBVEC
        MVI     A,BSELDK
        CALL    ADDA
        PCHL

; ONEFIL - the same of one file: a name, no * or ? in it, and the statement's end
; In, Out: as FILE   Clobbers all
ONEFIL: CALL    FILE
        LXI     H,FNAME+1
        MOV     A,M
        CPI     CBLANK
        JZ      ERTAPE
        MVI     B,11
ONEF1:  MOV     A,M
        CPI     CQUEST
        JZ      ERTAPE
        INX     H
        DCR     B
        JNZ     ONEF1
        DB      CHKEND
        RET

; FBLOCK - makes a block for the BDOS
; In:  HL-> name, DE-> block   Out: DE the same   Clobbers A, B, HL
FBLOCK: PUSH    D
        MVI     B,12
        CALL    FCOPY
        XRA     A
        MVI     B,24
FBLO1:  STAX    D
        INX     D
        DCR     B
        JNZ     FBLO1
        POP     D
        RET

; FCOPY - copies B bytes
; In:  HL-> from, DE-> to   Out: both behind, B = 0   Clobbers A
FCOPY:  MOV     A,M
        STAX    D
        INX     H
        INX     D
        DCR     B
        JNZ     FCOPY
        RET

; FTEMP - the block of the file that is written, with the type $$$
; In:  WNAME   Out: DE = WFCB   Clobbers A, B, HL
FTEMP:  LXI     H,WNAME
        LXI     D,WFCB
        CALL    FBLOCK
        LXI     H,CDOLLR*256+CDOLLR
        SHLD    WFCB+9
        MOV     A,H
        STA     WFCB+11
        RET

; WOPEN - a file is written from here on
; In:  FNAME, A = WTAPE or WSAVE   Out: ERR 10   Clobbers all
WOPEN:  PUSH    PSW
        MVI     A,WLOST
        STA     WMODE
        LXI     H,FNAME
        LXI     D,WNAME
        MVI     B,12
        CALL    FCOPY
        LXI     H,WNAME
        LXI     D,WFCB
        CALL    FBLOCK
        CALL    OPEN
        JZ      WOPEN1          ; there is none
        LDA     WFCB+9
        ORA     A
        JM      ERTAPE          ; it is write-protected
WOPEN1: MVI     C,FWHICH
        CALL    CPBDOS
        MOV     B,A
        LDA     WNAME
        DCR     A
        JP      WOPEN2
        MOV     A,B             ; the present drive
WOPEN2: PUSH    PSW
        MVI     C,FRODRV
        CALL    CPBDOS
        POP     PSW
        MOV     B,A
        INR     B
WOPEN3: MOV     A,H             ; CY = bit A of HL
        RAR
        MOV     H,A
        MOV     A,L
        RAR
        MOV     L,A
        DCR     B
        JNZ     WOPEN3
        JC      ERTAPE          ; the drive is
        CALL    FTEMP
        MVI     C,FDEL
        CALL    CPBDOS
        CALL    FTEMP
        MVI     C,FMAKE
        CALL    FCALL
        JZ      ERTAPE          ; no room in the directory
        XRA     A
        STA     WPOS
        POP     PSW
        STA     WMODE
        RET

; WPUT - a character to the file that is written
; In:  B   Out: ERR 10   Clobbers all
WPUT:   LDA     WMODE
        INR     A
        RZ                      ; WLOST
        LXI     H,WPOS
        MOV     E,M
        INR     M
        MVI     D,0
        LXI     H,WBUF
        DAD     D
        MOV     M,B
        LDA     WPOS
        ORA     A
        RP
        XRA     A
        STA     WPOS
        LXI     D,WBUF
        MVI     C,FDMA
        CALL    CPBDOS
        LXI     D,WFCB
        MVI     C,FWRITE
        CALL    CPBDOS
        ORA     A
        RZ
; (fall into WFAIL)

; WFAIL - the file cannot be written: it is taken back; goes to ERR, number 10
WFAIL:  LDA     WMODE
        CPI     WSAVE
        JNZ     WFAI1
        MVI     A,CLF           ; (the paper has nothing of the line that SAVE was at)
        STA     LASTC
WFAI1:  CALL    WDROP
        DB      ERROR,ETAPE

; WDROP - takes the file that is written back
; Clobbers all
WDROP:  MVI     A,WLOST
        STA     WMODE
        LXI     D,WFCB
        MVI     C,FCLOSE        ; (else its room stays taken)
        CALL    CPBDOS
        LXI     D,WFCB
        MVI     C,FDEL
        JMP     CPBDOS

; WCLOSE - the file that is written is whole: it takes its name
; Out: ERR 10   Clobbers all
WCLOSE: MVI     B,CEOF
        CALL    WPUT
        LDA     WPOS
        ORA     A
        JNZ     WCLOSE
        LXI     D,WFCB
        MVI     C,FCLOSE
        CALL    FCALL
        JZ      WFAIL
        LXI     H,WNAME
        LXI     D,WFCB2
        CALL    FBLOCK
        MVI     C,FDEL          ; the one that had the name
        CALL    CPBDOS
        CALL    FTEMP
        LXI     H,WNAME
        LXI     D,WFCB2
        MVI     B,12
        CALL    FCOPY
        LXI     D,WFCB
        MVI     C,FRENAM
        CALL    FCALL
        JZ      WFAIL
        XRA     A
        STA     WMODE
        RET

; BDPUN - punches a character (PAPER calls it): for a program that runs and a name that PUNCH has given,
;         or when SAVE writes
; In:  B   Clobbers A, BC, HL
BDPUN:  PUSH    D
        LDA     WMODE
        ORA     A
        JNZ     BDPU1
        LDA     PUNF
        ORA     A
        JZ      BDPU2
        LDA     NXTP+1
        ORA     A
        JZ      BDPU2           ; a direct statement
        PUSH    B
        LXI     H,PNAME
        LXI     D,FNAME
        MVI     B,12
        CALL    FCOPY
        MVI     A,WTAPE
        CALL    WOPEN
        POP     B
BDPU1:  CALL    WPUT
BDPU2:  POP     D
        RET

; BDREAD - next character of LOAD's file, then of the script
; Out: A = it, 0 when there is none   Clobbers nothing else
BDREAD: PUSH    B
        PUSH    D
        PUSH    H
        CALL    UNKEY
        LDA     FILEF
        ORA     A
        JZ      BDRE3
        LDA     RPOS
        ORA     A
        JP      BDRE1
        LXI     D,RBUF
        MVI     C,FDMA
        CALL    CPBDOS
        LXI     D,RFCB
        MVI     C,FREADR
        CALL    CPBDOS
        ORA     A
        JZ      BDRE1
        DCR     A
        JNZ     ERTAPE          ; (of CP/M 3: the disk)
        JMP     BDRE2           ; behind the last record
BDRE1:  LXI     H,RBUF
        MOV     E,A
        MVI     D,0
        DAD     D
        INR     A
        STA     RPOS
        MOV     A,M
        ANI     7FH
        CPI     CEOF
        JNZ     BDRE4
BDRE2:  XRA     A
        STA     FILEF
        MVI     A,CCR           ; a last line that nothing ends
        JMP     BDRE4
BDRE3:  LHLD    SCRP
        MOV     A,M
        INX     H
        ORA     A
        JZ      BDRE5
        SHLD    SCRP
        DB      SKIP2B          ; skips the MVI
BDRE5:  MVI     A,CEOF
BDRE4:  POP     H
        POP     D
        POP     B
        RET

; SLOAD - command: LOAD "NAME"; lines come from the file
SLOAD:  LXI     H,TYPSKG
        CALL    ONEFIL
        LXI     H,FNAME
        LXI     D,RFCB
        CALL    FBLOCK
        CALL    OPEN
        JZ      ERTAPE
        MVI     A,80H           ; RBUF is used up
        STA     RPOS
        STA     FILEF
        MVI     A,1
        STA     LOADF
        RET

TYPSKG: DB      "SKG"

; PUNOFF - punch off; the place for a break, since the block is complete
; Clobbers A, HL
PUNOFF  EQU     PAPON

; PUNON - what is printed from here on is punched too
; Clobbers A
PUNON:  MVI     A,1
        STA     OUTSEL
        RET

; BDOFF - after an error and at a tape's end: no more lines from a file, nor from the script
; Clobbers A, HL
BDOFF:  XRA     A
        STA     LOADF
        STA     FILEF
        LXI     H,BDZERO
        SHLD    SCRP
        RET
BDZERO: DB      0
