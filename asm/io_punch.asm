; io_punch.asm - punch and reader on a port of their own
; Offers: BDPUT BDREAD SLOAD PUNON
; Uses:   io io_6850 io_8251 start
; Room:   40 bytes

; BDPUT - punches a character
; In:  B   Clobbers A
BDPUT:  IN      PUNST
        ANI     TXRDY
        JZ      BDPUT
        MOV     A,B
        OUT     PUNDT
        RET

; BDREAD - a character from the reader
; Out: A = it and Z clear; 0 and Z when there is none   Clobbers nothing else
BDREAD: IN      PUNST
        ANI     RXRDY
        RZ
        IN      PUNDT
        RET

; SLOAD - command: LOAD; waits for the tape's first character, then lines come from it
SLOAD:  DB      CHKEND
SLOA1:  CALL    BREAK
        IN      PUNST
        ANI     RXRDY
        JZ      SLOA1
        INX     H               ; BREAK leaves HL-> KEYB: the next is LOADF
        MVI     M,1
        RET

; PUNON - what is printed from here on is punched too
; Clobbers A
PUNON:  MVI     A,1
        STA     OUTSEL
        RET
