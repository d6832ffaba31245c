; io_tape.asm - a character of the reader waits in KEYB, when lines come from there
; Offers: BDREAD TAPEIN
; Uses:   [ports]
; Room:   37 bytes

;! CCTLC+10H == CXOFF -- TAPEIN knows both keys at once

; BDREAD - a character from the reader: what TAPEIN has taken
; In:  HL-> KEYB   Out: A = it, 0 when there is none   Clobbers nothing else
BDREAD: MOV     A,M
        RET

; TAPEIN - takes a character of the reader, when lines come from there; of the keys only ctrl-C and ctrl-S count then
; In:  HL-> KEYB   Out: KEYB   Clobbers A
TAPEIN: INX     H
        LDA     CHKF            ; (1 at the prompt and while a line is parsed, 0 in INPUT)
        ANA     M               ; LOADF
        DCX     H
        RZ
        MOV     A,M
        ORI     10H
        CPI     CXOFF
        RZ
        MVI     M,0
        IN      PUNST
        ANI     RXRDY+RXOVR
        RZ
        ANI     RXOVR
        IN      PUNDT
        CALL    RXTAP
        CPI     CCTLC           ; a tape's ETX and X-OFF mean nothing: they are no keys
        RZ
        CPI     CXOFF
        RZ
        MOV     M,A
        RET
