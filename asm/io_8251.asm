; io_8251.asm - ports of the board: two Intel 8251
; Offers: TTYDT TTYST PUNDT PUNST TXRDY RXRDY BDINIT
; Uses:   io_ended
; Room:   23 bytes

TTYDT   EQU 10H         ; teletype: data
TTYST   EQU 11H         ; teletype: status and control
PUNDT   EQU 12H         ; punch and reader: data
PUNST   EQU 13H         ; punch and reader: status and control
TXRDY   EQU 01H         ; transmitter empty
RXRDY   EQU 02H         ; receiver full

USARUN  EQU 37H         ; command: transmitter and receiver on

; BDINIT - readies both ports, then goes to BDREST
BDINIT: LXI     H,BDTAB
BDINI1: MOV     A,M
        INX     H
        OUT     TTYST
        OUT     PUNST
        CPI     USARUN
        JNZ     BDINI1
        JMP     BDREST

BDTAB:  DB      0,0,0           ; ends whatever the 8251 was waiting for
        DB      40H             ; reset
        DB      0CEH            ; mode: 8 bits, no parity, 2 stop bits, clock / 16
        DB      USARUN
