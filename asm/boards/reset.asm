; reset.asm - what a board does that is alone with the ROM: reset, SAVE to the punch
; Offers: RESET SSAVE
; Uses:   [more] [punch] [start] calc io monitor program start
; Room:   60 bytes

; RESET - readies the ports (8 bits, 2 stop bits, clock / 16), finds the RAM, keeps what is
;         sound in it (keep.asm), or nothing, signs on and goes to READY
RESET:  LXI     SP,STKTOP
        CALL    CALINI
        LXI     H,0
        SHLD    KEYB            ; and LOADF
        DCR     H
        SHLD    CHKF            ; no check mode, paper on
        MVI     H,RAM/256
RESE2:  MOV     A,M             ; does this page keep what is written?
        INR     A
        INR     M
        CMP     M
        JNZ     RESE3
        DCR     M
        INR     H
        MOV     A,H             ; the last page of all memory is left alone, so that no sum of an
        INR     A               ; address and a length passes 0FFFFH
        JNZ     RESE2
RESE3:  DCX     H               ; HL-> last byte of RAM
        CALL    KEEP
        CALL    PUTSI
        DB      CCR,CLF,"SKG",0A0H
        JMP     FREE

; SSAVE - command: SAVE, SAVE n, SAVE n,m; ctrl-Z tells LOAD where the tape ends
SSAVE:  CALL    PUNON           ; (also when it is only parsed: nothing is printed then)
        CALL    SLIST
        MVI     A,CEOF
        DB      PUTC
        JMP     PUNOFF
