; rts.asm - /RTS of both receivers, one control word each: 6850, 8251
; Offers: BDRTS
; Uses:   [ports]
; Room:   5 bytes

; BDRTS - lets whoever sends to the board go on, or holds them
; In:  A = SIO8N2, SIOHLD   Clobbers nothing
BDRTS:  OUT     TTYST
        OUT     PUNST
        RET
