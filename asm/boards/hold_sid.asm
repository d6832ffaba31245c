; hold_sid.asm - a character is heard while it is waited for, bit by bit; nobody is held
; Offers: LISTEN LETGO ENDLIN LEXTOK LINGAP
; Uses:   [ports] decimal io start
; Room:   40 bytes

; LISTEN - hears a character that comes, looks for a break
; In, Out: as BREAK   Clobbers nothing else
LISTEN: LXI     H,KEYB
        MOV     A,M
        ORA     A
        JNZ     LISTE1
        DB      SIDIN
        ORA     A
        CP      SIDREC
        MOV     A,M
LISTE1: CPI     CCTLC
        RNZ
        JMP     BROKEN

; LETGO - looks for a break while a program runs
; In, Out: as BREAK
LETGO   EQU BREAK

; ENDLIN - the line has come
; Clobbers A
ENDLIN  EQU CRLF

; LEXTOK - LEXCH at a token's beginning; looks whether somebody types on
; In, Out: as LEXCH   Clobbers nothing else
LEXTOK: PUSH    H
        CALL    POLL
        POP     H
        JMP     LEXCH

; LINGAP - behind a line of LIST and SAVE: nothing
; Clobbers A
LINGAP  EQU CHECK
