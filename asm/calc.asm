; calc.asm - the calculator: byte-code over a stack of floats
; Offers: FSP CALINI RUNBC CALC0 ODUP OOVR COPY5 ODRP CALOP CALPOP OJN OJZ OJMP OJCY ODBL XSIG XMAX
;         XE6N ERGEO XXCH OSWP EXCHC
; Uses:   consts float start
; Room:   218 bytes
;
; RST 5 starts it; the byte-code stands behind the RST.  One byte an operation:
;
;   00      QEND    the program goes on in machine code behind it, A = 0, Z set, CY clear
;   01-3F           operation n of OPTAB
;   40-7F           push register M0 ... M63
;   80-BF           pop into register M0 ... M63
;   C0-D4           push constant 0 ... 20 of CONTAB
;   D5      QRET    back to who called the routine, A not 0, Z clear, CY set
;   D6-FF           operation 1 ... 2A, then back: QADD+QRET (A and the flags are QADD's)
;
; QJMP, QJN (pop, jump if negative) and QJZ (pop, jump if zero) are followed by
; the signed distance of their target from the distance byte itself:
;
;         DB      QJZ
;         DB      TARGET-$
;
; The stack grows upward in FSTK, a page's start; FSP -> its top (when it is empty, the low
; byte is 256-5).  There is no check for its end.  The code pointer lies on the 8080 stack while an operation runs, so
; an operation may use RST 5 itself.
;
; An operation is a subroutine:
; In:  HL -> top, DE -> second; FSP = HL, but for the numbers from OPPOP on FSP = DE, that is:
;      the top is popped, but still there to be read
; Out: FSP and floats   Clobbers all
; One from OPBYTE on is byte-code, up to QRET, or up to QEND and machine code behind it.

FSP     EQU FWORK+46    ; stack pointer of the calculator

; CALINI - empties the float stack
; Clobbers HL
CALINI: LXI     H,FSTK+256-5
        SHLD    FSP
        RET

; RUNBC - runs byte-code that ends with QEND and a RET, or with QRET
; In:  DE -> byte-code   Clobbers all
RUNBC:  PUSH    D
; (fall into CALC)

; CALC - runs byte-code (RST 5 jumps here)
; In:  on the stack: code pointer   Clobbers all
; Cycles: a load 283, a store 315, a constant 334, an operation 244 + its own, byte-code 158 + its own
CALC0:  POP     B
CALC1:  LDAX    B
        INX     B
        CPI     40H
        JC      CALOP
        LXI     H,CALC1
        PUSH    H
        MOV     L,A
        ANI     3FH
        MOV     E,A
        ADD     A
        ADD     A
        ADD     E
        MOV     E,A             ; CY,E = 5*number; the registers begin a page
        MVI     A,MREG/256
        ACI     0
        MOV     D,A             ; DE -> register
        MOV     A,L
        ADD     A
        JNC     OOVR            ; 01: push
        JP      CALPOP          ; 10: pop
        CPI     (2*QRET)&255
        JNC     CALC4           ; 11: operation and QRET
        LXI     H,CONTAB-MREG   ; 11: constant
        DAD     D
ODUP:   XCHG                    ; DE -> float
; (fall into OOVR)

; OOVR - QOVR: pushes a float
; In:  DE -> float   Out: DE, HL -> last bytes   Clobbers A
OOVR:   LHLD    FSP
        MOV     A,L
        ADI     5               ; FSTK lies within a page
        MOV     L,A
        STA     FSP
; (fall into COPY5)

; COPY5 - copies a float
; In:  DE -> from, HL -> to   Out: DE, HL -> last bytes   Clobbers A
; Cycles: 120
COPY5:  LDAX    D
        MOV     M,A
        INX     D
        INX     H
        LDAX    D
        MOV     M,A
        INX     D
        INX     H
        LDAX    D
        MOV     M,A
        INX     D
        INX     H
        LDAX    D
        MOV     M,A
        INX     D
        INX     H
        LDAX    D
        MOV     M,A
ODRP:   RET

; CALOP - an operation, or QEND (OPFN carries out an operation that way)
; In:  A = number, BC -> byte-code that goes on behind it   Clobbers all
CALOP:  PUSH    B
        ORA     A
        RZ                      ; QEND: on behind it
        LXI     H,CALC0
        PUSH    H               ; every operation returns there
        ADD     A
        ADI     OPTAB&255       ; (the table lies within a page)
CALC5:  MOV     C,A
        MOV     L,A
        MVI     H,OPTAB/256
        MOV     E,M
        INX     H
        MOV     D,M
        PUSH    D               ; operation
        CPI     2*OPBYTE+(OPTAB&255)
        JNC     CALC0           ; byte-code
        LHLD    FSP             ; HL -> top
        MOV     A,L             ; FSTK lies within a page
        SUI     5
        MOV     E,A
        MOV     D,H             ; DE -> second
        MOV     A,C
        CPI     2*OPPOP+(OPTAB&255)
        RC
        MOV     A,E
        STA     FSP
        RET
CALC4:  POP     H               ; not to CALC1: the operation returns to who called the byte-code
        ADI     (OPTAB-2*QRET)&255
        JMP     CALC5

; CALPOP - pops a float
; In:  DE -> where to   Out: DE, HL -> last bytes   Clobbers A
CALPOP: LHLD    FSP
        MOV     A,L
        SUI     5
        STA     FSP
        XCHG
        JMP     COPY5

OJN:    INX     H
        MOV     A,M
        RLC                     ; CY = sign
        JMP     OJCY
OJZ:    MOV     A,M
        SUI     1               ; CY: zero
        DB      SKIP1B          ; skips the STC
OJMP:   STC
; OJCY - jumps when CY is set (QJC ends here, too)
; In:  CY; on the stack: CALC, -> the distance   Clobbers all but B, C
OJCY:   POP     B               ; CALC
        POP     H
        MOV     A,M             ; distance
        JC      OJMP2
        MVI     A,1             ; no jump: over the distance byte
OJMP2:  MOV     E,A
        RLC
        SBB     A
        MOV     D,A
        DAD     D
        PUSH    H
        PUSH    B
        RET

; ODBL - QDBL: twice x
; In:  HL -> x   Out: x; ERR 05   Clobbers A
ODBL:   MOV     A,M
        ORA     A
        RZ
        INR     M               ; the exponent
        RNZ
        DB      ERROR,ERANGE

; QSIG: a number with its sign changed when a second one is negative
XSIG:   INX     H               ; -> sign of the second one
        MOV     A,M
        ORA     A
        RP
        XCHG
        JMP     FNEG

; QMAX: the greater of two (byte-code)
XMAX:   DB      QOVR,QOVR,QSUB,QJN ; x y
        DB      XMAX1-$
        DB      QDRP+QRET       ; x
XMAX1:  DB      QSWP,QDRP+QRET  ; y

; QE6N: takes a number, ERR 06 when it is negative
XE6N:   INX     H
        MOV     A,M
        ORA     A
        RP
ERGEO:  DB      ERROR,EGEOM

; XXCH - exchanges a and b (QXCH)
; Clobbers all
XXCH:   LXI     D,MA
        LXI     H,MVB
        MVI     C,15
        DB      SKIP2           ; skips the MVI
OSWP:   MVI     C,5
; EXCHC - exchanges C bytes at DE and HL, the first ones first
; Out: DE, HL behind them, C = 0   Clobbers A, B
EXCHC:  LDAX    D
        MOV     B,M
        MOV     M,A
        MOV     A,B
        STAX    D
        INX     H
        INX     D
        DCR     C
        JNZ     EXCHC
        RET
