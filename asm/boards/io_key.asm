; io_key.asm - the reader's characters come as keys do
; Offers: TAPEIN
; Uses:   nothing
; Room:   1 bytes

; TAPEIN - KEYB has the reader's character already
; Clobbers nothing
TAPEIN: RET
