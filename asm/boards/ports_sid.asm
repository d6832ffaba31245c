; ports_sid.asm - the clock of an 8085 whose own lines, SID and SOD, are the teletype: 3.072 MHz (a crystal of 6.144 MHz), 2,400 baud
; Offers: SIDRX SIDRX1 SIDTX SIDQT
; Uses:   nothing
; Room:   0 bytes
;
; A bit is 1,280 of the 8085's cycles.  At another clock the rate goes with it: 6.144 MHz, 4,800 baud.

SIDRX   EQU 88          ; turns of 14 cycles: a bit of 14 n + 51 cycles while it receives
SIDRX1  EQU 129         ; from where a start bit was seen to the middle of the first bit
SIDTX   EQU 87          ; a bit of 14 n + 61 cycles while it sends
SIDQT   EQU 330         ; turns of 39 cycles: ten bits
