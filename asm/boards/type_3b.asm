; type_3b.asm - type of a file with a 3B tape
; Offers: TAPTYP
; Uses:   nothing
; Room:   3 bytes

TAPTYP: DB      "3B "
