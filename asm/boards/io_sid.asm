; io_sid.asm - the teletype on the 8085's own lines, SID and SOD, bit by bit: a board without a serial chip
; Offers: SIDIN BDINIT PAPER POLL SIDREC
; Uses:   [ports] [punch] start
; Room:   155 bytes
;
; There is no receiver that keeps a character: one is heard while the board waits for it (hold_sid.asm).  Whenever the line is
; seen low elsewhere somebody types who is not waited for.  That is a break while a statement works, and at the prompt a lost
; character.  Nothing holds the sender.

SIDIN   EQU     20H             ; RIM: A's bit 7 is SID
SODOUT  EQU     30H             ; SIM: SOD becomes A's bit 7 where bit 6 is set
SODHI   EQU     0C0H            ; SOD high: nothing is sent

; BDINIT - the line at rest, then goes to BDREST
BDINIT: DI
        MVI     A,SODHI
        DB      SODOUT
        JMP     BDREST

; PAPER - prints a character, which the punch gets too when it is on
; In:  B = it, C = OUTSEL   Clobbers A, C, HL
PAPER:  MOV     A,C
        ORA     A
        RZ
        CALL    POLL
        PUSH    B
        MVI     H,0FFH          ; bit 7: SID has always been high
        MVI     C,11            ; start bit, 8, 2 stop bits
        ORA     A               ; CY = 0: the start bit is low
PAPER1: MVI     A,80H
        RAR
        DB      SODOUT
        DB      SIDIN
        ANA     H
        MOV     H,A
        MVI     L,SIDTX
PAPER2: DCR     L
        JNZ     PAPER2
        STC                     ; behind the character stop bits
        MOV     A,B
        RAR
        MOV     B,A
        DCR     C
        JNZ     PAPER1
        POP     B
        MOV     A,H
        ORA     A
        LXI     H,KEYB
        CP      SIDLOW
        DCR     C
        JZ      BDPUN
        RET

; POLL - looks whether somebody types who is not waited for
; Out: A = KEYB, HL-> it, Z: it is a break that has been waiting   Clobbers nothing else
POLL:   LXI     H,KEYB
        MOV     A,M
        CPI     CCTLC
        RZ                      ; a break waits
        DB      SIDIN
        ORA     A
        CP      SIDLOW
        MOV     A,M
        INR     A               ; (Z is clear: no key is FF)
        MOV     A,M
        RET

; SIDLOW - somebody does: waits until the line is at rest
; In:  HL-> KEYB   Out: KEYB = ctrl-C while a statement works, else CLOST   Clobbers A
SIDLOW: CALL    SIDQUI
        CALL    CHECK
        MVI     M,CLOST
        RNZ
        MVI     M,CCTLC
        RET

; SIDQUI - waits until the line has been high for a character's time
; Clobbers A
SIDQUI: PUSH    D
SIDQU1: LXI     D,SIDQT
SIDQU2: DB      SIDIN
        RAL
        JNC     SIDQU1
        DCX     D
        MOV     A,D
        ORA     E
        JNZ     SIDQU2
        POP     D
        RET

; SIDREC - a start bit has been seen: receives.  Without a stop bit it is a break
; In:  HL-> KEYB   Out: KEYB = the character without parity, 0 for ctrl-S; ctrl-C for a break   Clobbers A
SIDREC: PUSH    B
        LXI     B,SIDRX1*256+9
SIDRE1: DCR     B
        JNZ     SIDRE1
        DB      SIDIN
        RAL
        DCR     C
        JZ      SIDRE2          ; that was the stop bit
        MOV     A,M
        RAR
        MOV     M,A
        MVI     B,SIDRX
        JMP     SIDRE1
SIDRE2: POP     B
        JNC     SIDBRK
        MOV     A,M
        ANI     7FH
        MOV     M,A
        CPI     CXOFF
        RNZ
        MVI     M,0             ; nothing can wait for the next key
        RET
SIDBRK: MVI     M,CCTLC
        JMP     SIDQUI
