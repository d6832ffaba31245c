; hold.asm - whoever sends is held while a line is worked on
; Offers: ENDLIN LEXTOK
; Uses:   [ports] [punch] decimal io
; Room:   37 bytes
;
; /RTS is high from a line's end until the next character is wanted or a program runs.  A sender stops two characters
; late: KEYB takes the first one, the receiver keeps the second.

LATE    EQU     1200            ; turns of ENDL1, for a character at 110 baud

; ENDLIN - the line has come: holds the senders, takes what comes late, LF behind CR left out; waits no longer when KEYB
;          has it, since the receiver keeps the other one
; Clobbers A, DE, HL
ENDLIN: MVI     A,SIOHLD
        CALL    BDRTS
        CALL    CRLF
        LXI     D,LATE
ENDL1:  CALL    POLL
        ORA     A
        JZ      ENDL2
        XRI     CLF
        RNZ
        MOV     M,A
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
