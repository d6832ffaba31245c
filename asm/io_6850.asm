; io_6850.asm - ports of the board: two Motorola 6850 (MITS 88-2SIO)
; Offers: TTYST TTYDT PUNST PUNDT RXRDY TXRDY BDINIT
; Uses:   drive io_ended io_tty
; Room:   15 bytes

TTYST   EQU 10H         ; teletype: status and control
TTYDT   EQU 11H         ; teletype: data
PUNST   EQU 12H         ; punch and reader: status and control
PUNDT   EQU 13H         ; punch and reader: data
RXRDY   EQU 01H         ; receiver full
TXRDY   EQU 02H         ; transmitter empty

SIORST  EQU 03H         ; control: reset
SIO8N2  EQU 11H         ; control: 8 bits, no parity, 2 stop bits, clock / 16

; BDINIT - readies both ports, then goes to BDREST
BDINIT: MVI     A,SIORST
        OUT     TTYST
        OUT     PUNST
        MVI     A,SIO8N2
        OUT     TTYST
        OUT     PUNST
        JMP     BDREST
