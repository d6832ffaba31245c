; io_ended.asm - what a board does when a character is punched, when a block is complete, after an error and at reset:
; nothing but its serial ports
; Offers: BDPUN PUNOFF BDOFF BDREST
; Uses:   [punch] [start] io
; Room:   5 bytes

; BDPUN - punches a character (TYPECH of io.asm calls it)
; In:  B   Clobbers A
BDPUN   EQU BDPUT

; PUNOFF - punch off; the place for a break, since the block is complete
; Clobbers A, HL
PUNOFF  EQU PAPON

; BDOFF - after an error and at a tape's end: no more lines from the reader
; Clobbers A
BDOFF:  XRA     A
        STA     LOADF
        RET

; BDREST - what is readied at reset besides the serial ports: nothing; goes to RESET
BDREST  EQU RESET
