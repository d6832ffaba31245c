; ports_sio.asm - where the Z80 SIO is, and its clock: an RC2014 with an SIO/2 card
; Offers: TTYST TTYDT PUNST PUNDT SIOMOD
; Uses:   nothing
; Room:   0 bytes

TTYST   EQU 80H         ; channel A, teletype: status and control
TTYDT   EQU 81H         ; teletype: data
PUNST   EQU 82H         ; channel B, punch and reader: status and control
PUNDT   EQU 83H         ; punch and reader: data

SIOMOD  EQU 0C4H        ; WR4: clock / 64, 1 stop bit, no parity: 115,200 baud of 7.3728 MHz
