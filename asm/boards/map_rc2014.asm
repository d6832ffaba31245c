; map_rc2014.asm - where things lie: ROM at 0 and RAM in the upper half, as on an RC2014
; Offers: names for all

;! ERROR0 == 8 and PUTC0 == 10H and NEXT0 == 18H and EXPEC0 == 20H and PEEK0 == 30H and CHKEN0 == 38H -- the restarts go there
RAM     EQU 8000H       ; RAM, from a page's start
BDSTK   EQU 0           ; bytes of the stack that what is called outside the firmware may take

ORIGIN:
