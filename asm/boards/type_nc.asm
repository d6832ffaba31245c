; type_nc.asm - type of a file with ISO blocks
; Offers: TAPTYP
; Uses:   nothing
; Room:   3 bytes

TAPTYP: DB      "NC "
