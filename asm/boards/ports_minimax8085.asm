; ports_minimax8085.asm - where the one 8251 is: a MiniMax8085
; Offers: TTYDT TTYST PUNST
; Uses:   nothing
; Room:   0 bytes

TTYDT   EQU 08H         ; teletype: data
TTYST   EQU 09H         ; teletype: status and control
PUNDT   EQU TTYDT       ; punch and reader are the teletype's own
PUNST   EQU TTYST
