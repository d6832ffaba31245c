; hold_line.asm - whoever sends may go on while a line is typed; a tape has NULs for a reader that nobody can hold
; Offers: LISTEN LETGO LINGAP
; Uses:   [ports] [punch] io start
; Room:   19 bytes

; LISTEN - lets senders go on, and looks for a break before a character is waited for.  LETGO - the same while a program runs
; In, Out: as BREAK   Clobbers nothing else
LISTEN  EQU LETGO
LETGO:  MVI     A,SIO8N2
        CALL    BDRTS
        JMP     BREAK

; LINGAP - behind a line of LIST and SAVE.  A tape of SAVE has NULs there: at 10 characters a second time enough for LOAD
; Clobbers A
LINGAP: LDA     TOKS            ; the command's token
        SUI     TSAVE
        RNZ
        DB      PUTC
        DB      PUTC
        DB      PUTC
        DB      PUTC
        RET
