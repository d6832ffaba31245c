; io_tty.asm - punch and reader are the teletype's own, switched by DC1 to DC4
; Offers: BDREAD SLOAD PUNON BDPUN PUNOFF BDREST BDOFF
; Uses:   [punch] [start] io start
; Room:   43 bytes

; BDREAD - a character from the reader: what the keyboard has sent
; In:  HL -> KEYB   Out: A = it, 0 when there is none   Clobbers nothing else
BDREAD: MOV     A,M
        RET

; SLOAD - command: LOAD; starts the reader, waits for the tape's first character, then lines come
;         from it
SLOAD:  DB      CHKEND
        MVI     A,CXON
        DB      PUTC
SLOA1:  CALL    LISTEN
        ORA     A
        JZ      SLOA1
        INX     H               ; LISTEN leaves HL-> KEYB: the next is LOADF
        MVI     M,1
        RET

; PUNON - what is printed from here on is punched too
; Clobbers A
PUNON:  MVI     A,CDC2
        DB      PUTC
; (fall into BDPUN)

; BDPUN - punches a character (TYPECH of io.asm calls it, were OUTSEL 1): the teletype has done so
; Clobbers nothing
BDPUN:  RET

; PUNOFF - punch off; the place for a break, since the block is complete
; Clobbers A, HL
PUNOFF: MVI     A,CDC4
        DB      PUTC
        JMP     PAPON

; BDREST - what is readied at reset besides the serial port: nothing; goes to RESET
BDREST  EQU RESET

; BDOFF - after an error and at a tape's end: no more lines from the reader; punch and reader off
; Clobbers A, HL
BDOFF:  XRA     A
        STA     LOADF
        LXI     H,OUTSEL
        MVI     M,2             ; paper on
        MVI     A,CDC4
        DB      PUTC
        MVI     A,CXOFF
        DB      PUTC
        RET
