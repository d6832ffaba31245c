; io_6850.asm - the board's receivers and transmitters: Motorola 6850
; Offers: RXRDY RXOVR TXRDY BDINIT RXKEY RXTAP
; Uses:   [more] [ports] [punch]
; Room:   30 bytes

RXRDY   EQU 01H         ; receiver full
RXOVR   EQU 20H         ; overrun: behind the character that was read last, others were lost
TXRDY   EQU 02H         ; transmitter empty

SIORST  EQU 03H         ; control: reset

; BDINIT - readies both ports, then goes to BDREST
BDINIT: DI                      ; (a monitor that has loaded the firmware may use interrupts)
        MVI     A,SIORST
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
