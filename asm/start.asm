; start.asm - restarts and what happens at reset
; Offers: the restarts of equ.asm and the routines in the gaps between them
;         (DIGIT, ADDA, SREM), CHKEND, RESET
; Uses:   io (PUTC1), calc (CALC), monitor
; Room:   140 bytes
;
; The DS lines fill each gap up to the next restart: a routine that grows past it
; makes the count negative, and the assembler refuses it.

; RST 0 - reset
        JMP     RESET

; DIGIT - is the character a digit?
; In:  A   Out: CY set: yes, A = its value   Clobbers A
DIGIT:  SUI     CZERO
        CPI     10
        RET
        DS      08H-$

; RST 1 - ERROR: the statement ends, with the error whose number follows the RST
ERROR:  POP     H
        MOV     A,M             ; A = number
        LXI     SP,STKTOP
        JMP     ERR
        DS      10H-$

; RST 2 - PUTC: prints, and punches when the punch is on
; In:  A   Clobbers nothing
PUTC:   PUSH    PSW
        PUSH    H
        PUSH    B
        MOV     B,A
        JMP     PUTC1
        DS      18H-$

; RST 3 - NEXT: takes a token
; In:  TXTP   Out: A = token, Z at the line's end; TXTP behind it   Clobbers HL
NEXT:   RST     6
        INX     H
        SHLD    TXTP

; SREM - statement REM: nothing
SREM:   RET
        DS      20H-$

; RST 4 - EXPECT: takes a token, which must be the one that follows the RST
; In:  TXTP   Out: A = token; ERR 01   Clobbers HL
EXPECT: RST     3
        XTHL                    ; HL-> the byte behind the RST
        CMP     M
        INX     H
        XTHL
        RZ
        RST     1
        DB      ESYN
        DS      28H-$

; RST 5 - CALC: byte-code follows the RST
        JMP     CALC

; ADDA - adds A to HL
; In:  A, HL   Out: HL   Clobbers A
ADDA:   ADD     L
        MOV     L,A
        RNC
        INR     H
        RET
        DS      30H-$

; RST 6 - PEEK: looks at the next token
; In:  TXTP   Out: A = token, Z at the line's end; HL = TXTP   Clobbers nothing else
PEEK:   LHLD    TXTP
        MOV     A,M
        ORA     A
        RET
        DS      38H-$

; RST 7 - CHKEND: the statement must end here; in check mode it is left for good
; In:  TXTP, CHKF   Out: ERR 01   Clobbers A, HL
CHKEND: RST     4
        DB      TEOL
        LDA     CHKF
        ORA     A
        RZ
        JMP     CHKED

; RESET - finds the RAM, readies the ports, keeps a sound program, signs on
RESET:  LXI     SP,STKTOP
        CALL    CALINI
        CALL    IOINIT
        LXI     H,0
        SHLD    KEYB            ; and LOADF
        INR     H               ; no check mode, paper on
        SHLD    CHKF
        LXI     H,RAM
RES1:   MOV     A,M             ; does this page keep what is written?
        CMA
        MOV     M,A
        CMP     M
        CMA
        MOV     M,A             ; (flags stay)
        JNZ     RES2
        INR     H
        JNZ     RES1
RES2:   DCX     H               ; HL-> last byte of RAM
        XCHG
        LHLD    VTOP
        CALL    CPHD
        XCHG
        SHLD    VTOP
        JNZ     RES3            ; not the RAM that it was
        LHLD    SIGNED
        LXI     D,SIGNAT
        CALL    CPHD
        XCHG
        SHLD    SIGNED
        CNZ     NEW1
        CALL    RUNINI
        JMP     RES4
RES3:   LXI     H,SIGNAT
        SHLD    SIGNED
        CALL    NEW1
RES4:   CALL    CRLF
        CALL    PUTSI
        DB      "SKG",0A0H
        CALL    FREE1
        JMP     READY
