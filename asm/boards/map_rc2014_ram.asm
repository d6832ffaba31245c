; map_rc2014_ram.asm - where things lie: an RC2014 whose ROM keeps its place; a monitor or MS BASIC loads the firmware
; Offers: names for all

;! ZBEND <= RAM -- the firmware, then its RAM
RAM     EQU 0B400H      ; RAM, from a page's start
BDSTK   EQU 0           ; bytes of the stack that what is called outside the firmware may take

        DS      9000H
ORIGIN:
