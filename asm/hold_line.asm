; hold_line.asm - whoever sends may go on while a line is typed
; Offers: LISTEN LETGO
; Uses:   [ports] [punch] io
; Room:   8 bytes

; LISTEN - lets senders go on, and looks for a break before a character is waited for.  LETGO - the same while a program runs
; In, Out: as BREAK   Clobbers nothing else
LISTEN  EQU LETGO
LETGO:  MVI     A,SIO8N2
        CALL    BDRTS
        JMP     BREAK
