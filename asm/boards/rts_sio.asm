; rts_sio.asm - /RTS of both receivers: Z80 SIO
; Offers: BDRTS
; Uses:   [ports]
; Room:   31 bytes

; BDRTS - lets whoever sends to the board go on, or holds them.  /RTS rises when the transmitter is empty: so that the
;         echo of what comes late does not put that off, waits for it
; In:  A = SIO8N2, SIOHLD   Clobbers A
BDRTS:  PUSH    PSW
        MVI     A,SIOWR5
        OUT     TTYST
        OUT     PUNST
        POP     PSW
        OUT     TTYST
        OUT     PUNST
        CPI     SIOHLD
        RNZ
BDRTS1: MVI     A,SIORR1
        OUT     TTYST
        IN      TTYST
        ANI     SIOSNT
        JZ      BDRTS1
        RET
