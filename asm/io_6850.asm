; io_6850.asm - ports of the board: two Motorola 6850 (MITS 88-2SIO)
; Offers: TTYST TTYDT PUNST PUNDT RXRDY RXOVR TXRDY SIO8N2 SIOHLD BDINIT RXKEY RXTAP
; Uses:   drive io_ended io_tty
; Room:   29 bytes

TTYST   EQU 10H         ; teletype: status and control
TTYDT   EQU 11H         ; teletype: data
PUNST   EQU 12H         ; punch and reader: status and control
PUNDT   EQU 13H         ; punch and reader: data
RXRDY   EQU 01H         ; receiver full
RXOVR   EQU 20H         ; overrun: behind the character that was read last, others were lost
TXRDY   EQU 02H         ; transmitter empty

SIORST  EQU 03H         ; control: reset
SIO8N2  EQU 11H         ; control: 8 bits, no parity, 2 stop bits, clock / 16; /RTS low: send
SIOHLD  EQU 51H         ; the same with /RTS high: wait

; BDINIT - readies both ports, then goes to BDREST
BDINIT: MVI     A,SIORST
        OUT     TTYST
        OUT     PUNST
        MVI     A,SIO8N2
        OUT     TTYST
        OUT     PUNST
        JMP     BDREST

; RXKEY - judges a character that a receiver had.  After an overrun it is the one that was read before, once more
; In:  A = character, Z clear: one is lost   Out: A = it without parity, 0 and Z for NUL; CLOST, but ctrl-C goes first
; Clobbers nothing else
RXKEY:  JNZ     RXLOST
        ANI     7FH
        RET
RXLOST: ANI     7FH
        CPI     CCTLC
        RZ
        MVI     A,CLOST
        RET

; RXTAP - the same for a character of the reader
RXTAP   EQU RXKEY
