; start.asm - restarts, and what stands in the gaps between them
; Offers: ERROR PUTC NEXT EXPECT CALC PEEK CHKEND CHECK ERROR0 PUTC0 NEXT0 TAKEHL ERMEM EXPEC0 ERSYN
;         ADDA PEEK0 ERDATA CHKEN0 SREM CPHD
; Uses:   [ports] [start] calc io monitor
; Room:   71 bytes
;
; The DS lines fill each gap up to the next restart.  asm80 does not refuse a routine that
; grows past it; a test looks at the GAP labels.

; The restarts' bytes (equ.asm says why they are data)
ERROR   EQU     0CFH
PUTC    EQU     0D7H
NEXT    EQU     0DFH
EXPECT  EQU     0E7H
CALC    EQU     0EFH
PEEK    EQU     0F7H
CHKEND  EQU     0FFH

;! ERROR == 0C7H+8 and PUTC == 0C7H+10H and NEXT == 0C7H+18H and EXPECT == 0C7H+20H -- RST n is one byte
;! CALC == 0C7H+28H and PEEK == 0C7H+30H and CHKEND == 0C7H+38H -- RST n is one byte
; RST 0 - reset
        JMP     BDINIT

; CHECK - is the statement only parsed?
; In:  CHKF   Out: A = CHKF, Z: no, it works   Clobbers nothing else
CHECK:  LDA     CHKF
        ORA     A
        RET
GAP08:  DS      08H-$

; RST 1 - ERROR: the statement ends, with the error whose number follows the RST
ERROR0: POP     H
        MOV     A,M             ; A = number
        LXI     SP,STKTOP
        JMP     ERR
GAP10:  DS      10H-$

; RST 2 - PUTC: prints, and punches when the punch is on
; In:  A, whose bit 7 does not count   Clobbers nothing
PUTC0:  PUSH    PSW
        PUSH    H
        PUSH    B
        ANI     7FH
        JMP     TYPECH
GAP18:  DS      18H-$

; RST 3 - NEXT: takes a token
; In:  TXTP   Out: A = token, Z at the line's end; TXTP behind it   Clobbers HL
NEXT0:  DB      PEEK
; TAKEHL - the next token is that behind HL (READI takes an item here, OPFLT a number)
; Out: TXTP = HL+1   Clobbers HL
TAKEHL: INX     H
        SHLD    TXTP
        RET

ERMEM:  DB      ERROR,EMEM
GAP20:  DS      20H-$

; RST 4 - EXPECT: takes a token, which must be the one that follows the RST
; In:  TXTP   Out: A = token; ERR 01   Clobbers HL
EXPEC0: DB      NEXT
        XTHL                    ; HL-> the byte behind the RST
        CMP     M
        INX     H
        XTHL
        RZ
ERSYN:  DB      ERROR,ESYN
GAP28:  DS      28H-$

; RST 5 - CALC: byte-code follows the RST
        JMP     CALC0

; ADDA - adds A to HL
; In:  A, HL   Out: HL   Clobbers A
ADDA:   ADD     L
        MOV     L,A
        RNC
        INR     H
        RET
GAP30:  DS      30H-$

; RST 6 - PEEK: looks at the next token
; In:  TXTP   Out: A = token, Z at the line's end; HL = TXTP   Clobbers nothing else
PEEK0:  LHLD    TXTP
        MOV     A,M
        ORA     A
        RET

ERDATA: DB      ERROR,EDATA
GAP38:  DS      38H-$

; RST 7 - CHKEND: the statement must end here; in check mode it is left for good
; In:  TXTP, CHKF   Out: ERR 01   Clobbers A, HL
CHKEN0: DB      EXPECT,TEOL
; SREM - statement: REM text
SREM:   CALL    CHECK
        RZ
        JMP     CHKED

; CPHD - compares
; In:  HL, DE   Out: flags of HL - DE: CY less, Z equal   Clobbers A
CPHD:   MOV     A,H
        CMP     D
        RNZ
        MOV     A,L
        CMP     E
        RET
