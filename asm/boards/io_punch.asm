; io_punch.asm - punch and reader on a port of their own
; Offers: BDPUT SLOAD PUNON
; Uses:   [ports] [punch] start
; Room:   32 bytes

; BDPUT - punches a character
; In:  B   Clobbers A
BDPUT:  IN      PUNST
        ANI     TXRDY
        JZ      BDPUT
        MOV     A,B
        OUT     PUNDT
        RET

; SLOAD - command: LOAD; waits for the tape's first character, then lines come from it
SLOAD:  DB      CHKEND
SLOA1:  CALL    LISTEN
        IN      PUNST
        ANI     RXRDY
        JZ      SLOA1
        INX     H               ; LISTEN leaves HL-> KEYB: the next is LOADF
        MVI     M,1
        RET

; PUNON - what is printed from here on is punched too
; Clobbers A
PUNON:  MVI     A,1
        STA     OUTSEL
        RET
