; hold.asm - whoever sends is held while a line is worked on
; Offers: ENDLIN LEXTOK
; Uses:   [ports] [punch] decimal io
; Room:   36 bytes
;
; /RTS is high from a line's end until the next character is wanted or a program runs.  A sender stops two characters
; late: KEYB takes the first one, the receiver keeps the second.

; ENDLIN - the line has come: holds the senders, takes what comes late, LF behind CR left out; waits longer than the line's
;          last character took (of a slow one up to 0.2 s); no longer when KEYB has one, since the receiver keeps the other
; In:  DE: turns to wait, as GETLIN has counted them, but for bits 15 to 11   Clobbers A, DE, HL
ENDLIN: MVI     A,SIOHLD
        CALL    BDRTS
        CALL    CRLF
ENDL1:  CALL    POLL
        ORA     A
        JZ      ENDL2
        XRI     CLF
        RNZ
        MOV     M,A
ENDL2:  DCX     D
        MOV     A,D
        ANI     7
        ORA     E
        JNZ     ENDL1
        RET

; LEXTOK - LEXCH at a token's beginning; who sends slowly is heard meanwhile
; In, Out: as LEXCH   Clobbers nothing else
LEXTOK: PUSH    H
        CALL    POLL
        POP     H
        JMP     LEXCH
