; hold_key.asm - whoever sends is held while a key is worked on, too: at 115,200 baud the next one comes before it is done
; Offers: LISTEN LETGO LINGAP
; Uses:   [ports] [punch] io start
; Room:   24 bytes
;
; A 6850 keeps one character, and a sender stops two late: the echo of the key takes the first one into KEYB, or the next
; LISTEN does, before the second one has come.

; LISTEN - holds senders when a key has come, else lets them go on; looks for a break
; In, Out: as BREAK   Clobbers nothing else
LISTEN: CALL    BREAK
        ORA     A
        MVI     A,SIO8N2
        JZ      LISTE1
        MVI     A,SIOHLD
LISTE1: CALL    BDRTS
        MOV     A,M
        RET

; LETGO - lets senders go on while a program runs; looks for a break
; In, Out: as BREAK   Clobbers nothing else
LETGO:  MVI     A,SIO8N2
        CALL    BDRTS
        JMP     BREAK

; LINGAP - behind a line of LIST and SAVE: nothing
; Clobbers A
LINGAP  EQU CHECK
