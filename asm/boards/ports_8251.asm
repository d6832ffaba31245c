; ports_8251.asm - where two 8251s are
; Offers: TTYDT TTYST PUNDT PUNST
; Uses:   nothing
; Room:   0 bytes

TTYDT   EQU 10H         ; teletype: data
TTYST   EQU 11H         ; teletype: status and control
PUNDT   EQU 12H         ; punch and reader: data
PUNST   EQU 13H         ; punch and reader: status and control
