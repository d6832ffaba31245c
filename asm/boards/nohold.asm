; nohold.asm - nobody is held: a line that lost characters is refused
; Offers: LISTEN ENDLIN LEXTOK LINGAP
; Uses:   decimal io start
; Room:   0 bytes

; LISTEN - looks for a break before a character is waited for
; In, Out: as BREAK
LISTEN  EQU BREAK

; ENDLIN - the line has come
; Clobbers A
ENDLIN  EQU CRLF

; LEXTOK - LEXCH at a token's beginning
; In, Out: as LEXCH   Clobbers nothing else
LEXTOK  EQU LEXCH

; LINGAP - behind a line of LIST and SAVE: nothing
; Clobbers A
LINGAP  EQU CHECK
