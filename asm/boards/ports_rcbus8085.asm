; ports_rcbus8085.asm - where the one 6850 is, and its clock: an RCBus with an 8085 and an ACIA card
; Offers: TTYST TTYDT PUNST SIO8N2 SIOHLD
; Uses:   nothing
; Room:   0 bytes

TTYST   EQU 0A0H        ; teletype: status and control
TTYDT   EQU 0A1H        ; teletype: data
PUNST   EQU TTYST       ; punch and reader are the teletype's own
PUNDT   EQU TTYDT

SIO8N2  EQU 16H         ; control: 8 bits, no parity, 1 stop bit, clock / 64: 115,200 baud of 7.3728 MHz; /RTS low: send
SIOHLD  EQU 56H         ; the same with /RTS high: wait
