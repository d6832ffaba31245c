; nohold.asm - nobody is held: a line that lost characters is refused
; Offers: LISTEN LETGO ENDLIN LEXTOK
; Uses:   decimal io
; Room:   0 bytes

; LISTEN - looks for a break before a character is waited for.  LETGO - the same while a program runs
; In, Out: as BREAK
LISTEN  EQU BREAK
LETGO   EQU BREAK

; ENDLIN - the line has come
; Clobbers A
ENDLIN  EQU CRLF

; LEXTOK - LEXCH at a token's beginning
; In, Out: as LEXCH   Clobbers nothing else
LEXTOK  EQU LEXCH
