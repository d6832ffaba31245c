; ports_2sio.asm - where the two 6850s are, and their clock: a MITS 88-2SIO
; Offers: TTYST TTYDT PUNST PUNDT SIO8N2 SIOHLD
; Uses:   nothing
; Room:   0 bytes

TTYST   EQU 10H         ; teletype: status and control
TTYDT   EQU 11H         ; teletype: data
PUNST   EQU 12H         ; punch and reader: status and control
PUNDT   EQU 13H         ; punch and reader: data

SIO8N2  EQU 11H         ; control: 8 bits, no parity, 2 stop bits, clock / 16; /RTS low: send
SIOHLD  EQU 51H         ; the same with /RTS high: wait
