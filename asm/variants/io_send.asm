; io_send.asm - blocks go out one behind the other, each with CR LF
; Offers: BLKON BLKOFF
; Uses:   [punch] io
; Room:   6 bytes

; BLKON - a block begins: what is printed from here on is punched too
; Clobbers A
BLKON   EQU PUNON

; BLKOFF - a block ends; the place for a break
; Clobbers A, HL
BLKOFF: CALL    CRLF
        JMP     PUNOFF
