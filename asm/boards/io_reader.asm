; io_reader.asm - a character of the reader is taken where it is wanted
; Offers: BDREAD
; Uses:   [ports]
; Room:   12 bytes

; BDREAD - a character from the reader
; Out: A = it and Z clear, CLOST when one is lost; 0 and Z when there is none   Clobbers nothing else
BDREAD: IN      PUNST
        ANI     RXRDY+RXOVR
        RZ
        ANI     RXOVR
        IN      PUNDT
        JMP     RXTAP
