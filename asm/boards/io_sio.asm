; io_sio.asm - the board's receivers and transmitters: Z80 SIO
; Offers: RXRDY RXOVR TXRDY SIORR1 SIOWR5 SIOSNT SIO8N2 SIOHLD BDINIT RXKEY RXTAP
; Uses:   [ports] [punch]
; Room:   78 bytes
;
; A byte to a control port goes to WR0, or to the register whose number WR0 has got; a status is RR0, or likewise.
; A receiver keeps three characters; of those that come too late the last one takes the third one's place.

RXRDY   EQU 01H         ; RR0: receiver has a character
RXOVR   EQU 0           ; (RR0 does not tell an overrun: RXKEY and RXTAP look at RR1)
TXRDY   EQU 04H         ; RR0: transmitter takes a character
SIORR1  EQU 01H         ; WR0: RR1 is next
SIOWR5  EQU 05H         ; WR0: WR5 is next
SIORST  EQU 18H         ; WR0: reset of the channel
SIOERR  EQU 30H         ; WR0: reset of errors
SIOSNT  EQU 01H         ; RR1: all is sent
SIOOVR  EQU 20H         ; RR1: in front of the character that was read, others were lost; stays until SIOERR

SIO8N2  EQU 0EAH        ; WR5: transmitter on, 8 bits, /DTR and /RTS low: send
SIOHLD  EQU 0E8H        ; WR5: the same with /RTS high: wait

; BDINIT - readies both channels, then goes to BDREST
BDINIT: DI                      ; (a monitor that has loaded the firmware may use interrupts)
        LXI     H,BDTAB
BDINI1: MOV     A,M
        INX     H
        OUT     TTYST
        OUT     PUNST
        CPI     SIO8N2
        JNZ     BDINI1
        JMP     BDREST

BDTAB:  DB      SIORST
        DB      4,SIOMOD
        DB      1,0             ; no interrupts
        DB      3,0C1H          ; receiver on, 8 bits; it looks at no modem line
        DB      SIOWR5,SIO8N2

; RXKEY - judges a character that the teletype's receiver had
; In:  A = character, Z clear: one is lost   Out: A = it without parity, 0 and Z for NUL; CLOST, but ctrl-C goes first
; Clobbers nothing else
RXKEY:  JNZ     RXLOST
        PUSH    PSW
        MVI     A,SIORR1
        OUT     TTYST
        IN      TTYST
        ANI     SIOOVR
        JZ      RXGOOD
        MVI     A,SIOERR
        OUT     TTYST
        JMP     RXOVER

; RXTAP - the same for the reader's receiver; RXOVER, RXGOOD and RXLOST: RXKEY goes on there, to
;         the first two with PSW on the stack
; In:  A = character   Out: as RXKEY   Clobbers nothing else
RXTAP:  PUSH    PSW
        MVI     A,SIORR1
        OUT     PUNST
        IN      PUNST
        ANI     SIOOVR
        JZ      RXGOOD
        MVI     A,SIOERR
        OUT     PUNST
RXOVER: POP     PSW
RXLOST: ANI     7FH
        CPI     CCTLC
        RZ
        MVI     A,CLOST
        RET
RXGOOD: POP     PSW
        ANI     7FH
        RET
