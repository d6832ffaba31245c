; io_8251.asm - the board's receivers and transmitters: Intel 8251
; Offers: TXRDY RXRDY RXOVR SIO8N2 SIOHLD BDINIT RXKEY RXTAP
; Uses:   [ports] [punch]
; Room:   70 bytes

TXRDY   EQU 01H         ; transmitter empty
RXRDY   EQU 02H         ; receiver full
RXOVR   EQU 10H         ; overrun: in front of the character that is there, others were lost

USARUN  EQU 37H         ; command: transmitter and receiver on, /RTS low, errors reset
SIO8N2  EQU 27H         ; the same without resetting errors
SIOHLD  EQU 07H         ; and with /RTS high: wait

; BDINIT - readies both ports, then goes to BDREST.  One behind the other: where they are one chip it is readied twice, while
;          each word written to it twice would leave it synchronous
BDINIT: LXI     H,BDTAB
BDINI1: MOV     A,M
        INX     H
        OUT     TTYST
        CPI     USARUN
        JNZ     BDINI1
        LXI     H,BDTAB
BDINI2: MOV     A,M
        INX     H
        OUT     PUNST
        CPI     USARUN
        JNZ     BDINI2
        JMP     BDREST

BDTAB:  DB      0,0,0           ; ends whatever the 8251 was waiting for
        DB      40H             ; reset
        DB      0CEH            ; mode: 8 bits, no parity, 2 stop bits, clock / 16
        DB      USARUN

; RXKEY - judges a character that the teletype's receiver had
; In:  A = character, Z clear: one is lost   Out: A = it without parity, 0 and Z for NUL; CLOST, but ctrl-C goes first
; Clobbers nothing else
RXKEY:  JZ      RXGOOD
        PUSH    PSW
        MVI     A,USARUN
        OUT     TTYST
        JMP     RXLOST

; RXTAP - the same for the reader's receiver; RXLOST and RXGOOD: RXKEY goes on there, to
;         RXLOST with PSW on the stack
; Clobbers nothing
RXTAP:  JZ      RXGOOD
        PUSH    PSW
        MVI     A,USARUN
        OUT     PUNST
RXLOST: POP     PSW
        ANI     7FH
        CPI     CCTLC
        RZ
        MVI     A,CLOST
        RET
RXGOOD: ANI     7FH
        RET
