; rts.asm - /RTS of both receivers, one control word each: 6850, 8251
; Offers: BDRTS
<<<<<<< HEAD
; Uses:   [ports]
=======
; Uses:   ports_2sio ports_8251 ports_rc2014
>>>>>>> 936bd41 (boards.md: pasting on an RC2014, a board of one's own by two examples, the Altair-Duino; skg term --board rc2014)
; Room:   5 bytes

; BDRTS - lets whoever sends to the board go on, or holds them
; In:  A = SIO8N2, SIOHLD   Clobbers nothing
BDRTS:  OUT     TTYST
        OUT     PUNST
        RET
