; letgo.asm - a line of the program begins, where nobody is held and no machine is driven
; Offers: LETGO
; Uses:   io
; Room:   0 bytes

; LETGO - looks for a break
; In, Out: as BREAK
LETGO   EQU BREAK
