; hold.asm - whoever sends is held while a line is worked on
; Offers: LISTEN ENDLIN LEXTOK
; Uses:   decimal io io_8251 io_held ports_2sio ports_rc2014
; Room:   46 bytes
;
; /RTS is high from a line's end until the next character is wanted or a program runs.  A sender stops two characters
; late: KEYB takes the first one, the receiver keeps the second.

LATE    EQU     1200            ; turns of ENDL1, for a character at 110 baud

; LISTEN - lets senders go on; looks for a break
; In, Out: as BREAK   Clobbers nothing else
LISTEN: MVI     A,SIO8N2
        OUT     TTYST
        OUT     PUNST
        JMP     BREAK

; ENDLIN - the line has come: holds the senders, takes what comes late, LF behind CR left out
; Clobbers A, DE, HL
ENDLIN: MVI     A,SIOHLD
        OUT     TTYST
        OUT     PUNST
        CALL    CRLF
        LXI     D,LATE
ENDL1:  CALL    POLL
        CPI     CLF
        JNZ     ENDL2
        MVI     M,0
ENDL2:  DCX     D
        MOV     A,D
        ORA     E
        JNZ     ENDL1
        RET

; LEXTOK - LEXCH at a token's beginning; who sends slowly is heard meanwhile
; In, Out: as LEXCH   Clobbers nothing else
LEXTOK: PUSH    H
        CALL    POLL
        POP     H
        JMP     LEXCH
