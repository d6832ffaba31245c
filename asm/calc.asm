; calc.asm - the calculator: byte-code over a stack of floats
; Offers: QEND QJN QJZ QDRP QSIG QMAX QE6N QJMP QRET QDUP QOVR QSWP QDBL QOWN CALINI FUN RUNBC CALC0
;         OOVR COPY5 CALPOP OJMP1 ERGEO XXCH OSWP1 OPTAB
; Uses:   consts float start
; Room:   277 bytes
;
; RST 5 starts it; the byte-code stands behind the RST.  One byte an operation:
;
;   00      QEND    the program goes on in machine code behind it, A = 0, Z set, CY clear
;   01-3F           operation n of OPTAB
;   40-7F           push register M0 ... M63
;   80-BF           pop into register M0 ... M63
;   C0-FF           push constant 0 ... 63 of CONTAB
;
; QJMP, QJN (pop, jump if negative) and QJZ (pop, jump if zero) are followed by
; the signed distance of their target from the distance byte itself:
;
;         DB      QJZ
;         DB      TARGET-$
;
; The stack grows upward in FSTK; FSP -> behind its top.  There is no check for
; its end.  The code pointer lies on the 8080 stack while an operation runs, so
; an operation may use RST 5 itself.
;
; An operation is a subroutine:
; In:  HL -> top, DE -> second, FSP -> behind the top; for the numbers up to QPOP
;      FSP = HL, that is: the top is popped, but still there to be read
; Out: FSP and floats   Clobbers all

FSP     EQU FWORK+46    ; stack pointer of the calculator

QEND    EQU 00H
QADD    EQU 01H         ; x y -> x+y
QSUB    EQU 02H         ; x y -> x-y
QMUL    EQU 03H         ; x y -> x*y
QDIV    EQU 04H         ; x y -> x/y
QJN     EQU 05H         ; x ->
QJZ     EQU 06H         ; x ->
QDRP    EQU 07H         ; x ->
QSIG    EQU 08H         ; x y -> x, or -x when y is negative
QMAX    EQU 09H         ; x y -> the greater; neither may be negative (else but: 0 when both are 0)
QE6N    EQU 0AH         ; x ->    ERR 06 when negative
QPOP    EQU 0AH         ; the last that pops
QJMP    EQU 0BH
QRET    EQU 0CH         ; ends the byte-code and returns from the routine, A not 0, Z clear
QDUP    EQU 0DH         ; x -> x x
QOVR    EQU 0EH         ; x y -> x y x
QSWP    EQU 0FH         ; x y -> y x
QSQ     EQU 10H         ; x -> x*x
QDBL    EQU 11H         ; x -> x+x
QNEG    EQU 12H         ; x -> -x
QFLR    EQU 13H         ; x -> greatest whole number not above
QSQRT   EQU 14H         ; x -> square root
QSIN    EQU 15H         ; x -> sine of x degrees
QCOS    EQU 16H
QTG     EQU 17H
QATG    EQU 18H         ; x -> arc tangent in degrees
QABS    EQU 19H         ; x -> |x|
QOWN    EQU 1AH         ; number of the first operation that another file adds

; CALINI - empties the float stack
; Clobbers HL
CALINI: LXI     H,FSTK
        SHLD    FSP
        RET

; FUN - puts x on the float stack and runs the byte-code behind the call; when the routine that
;       called FUN returns, what is on top there goes back to x
; In:  HL -> x, on the stack: code pointer   Clobbers all
FUN:    XCHG
        POP     H
        PUSH    D
        LXI     B,FUN1
        PUSH    B
        PUSH    H
        CALL    OOVR
        POP     D
; (fall into RUNBC)

; RUNBC - runs byte-code that ends with QEND and a RET, or with QRET
; In:  DE -> byte-code   Clobbers all
RUNBC:  PUSH    D
; (fall into CALC)

; CALC - runs byte-code (RST 5 jumps here)
; In:  on the stack: code pointer   Clobbers all
; Cycles: a load 283, a store 315, a constant 317, an operation 235 + its own
CALC0:  POP     B
CALC1:  LDAX    B
        INX     B
        CPI     40H
        JC      CALC3
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
        LXI     H,CONTAB-MREG   ; 11: constant
        DAD     D
ODUP:   XCHG                    ; DE -> float
; (fall into OOVR)

; OOVR - QOVR: pushes a float
; In:  DE -> float   Out: DE, HL -> last bytes   Clobbers A
OOVR:   LHLD    FSP
        MOV     A,L
        ADI     5               ; FSTK lies within a page
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

; an operation, or QEND
CALC3:  PUSH    B
        ORA     A
        RZ                      ; QEND: on behind it
        LXI     H,CALC0
        PUSH    H               ; every operation returns there
        LXI     H,OPTAB-2
        ADD     A
        MOV     C,A
        MVI     B,0
        DAD     B
        MOV     E,M
        INX     H
        MOV     D,M
        PUSH    D               ; operation
        LHLD    FSP
        MOV     A,L             ; FSTK lies within a page
        SUI     5
        MOV     L,A             ; HL -> top
        SUI     5
        MOV     E,A
        MOV     D,H             ; DE -> second
        MOV     A,C
        CPI     2*QPOP+1
        RNC
        SHLD    FSP
        RET

FUN1:   POP     D
; (fall into CALPOP)

; CALPOP - pops a float
; In:  DE -> where to   Out: DE, HL -> last bytes   Clobbers A
CALPOP: LHLD    FSP
        MOV     A,L
        SUI     5
        MOV     L,A
        SHLD    FSP
        XCHG
        JMP     COPY5

OJN:    INX     H
        MOV     A,M
        RLC                     ; CY = sign
        JMP     OJMP1
OJZ:    MOV     A,M
        SUI     1               ; CY: zero
        DB      SKIP1B          ; skips the STC
OJMP:   STC
OJMP1:  POP     B               ; CALC
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

ORET:   POP     H               ; CALC
        POP     H               ; code pointer
        RET

; ODBL - QDBL: x + x
; In:  HL -> x   Out: x; ERR 05   Clobbers all
ODBL:   MOV     D,H
        MOV     E,L
        JMP     FADD

; QSIG: a number with its sign changed when a second one is negative
XSIG:   INX     H               ; -> sign of the second one
        MOV     A,M
        ORA     A
        RP
        XCHG
        JMP     FNEG

; QMAX: the greater of two that are not negative: their bytes can be compared one by one
XMAX:   PUSH    H
        PUSH    D
XMAX1:  LDAX    D
        CMP     M
        INX     D
        INX     H
        JZ      XMAX1           ; (past the end of equal ones, which does not matter)
        POP     D
        POP     H
        RNC
        XCHG
        JMP     COPY5

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
; OSWP1 - exchanges C bytes at DE and HL, the first ones first (fit.asm comes here)
OSWP1:  LDAX    D
        MOV     B,M
        MOV     M,A
        MOV     A,B
        STAX    D
        INX     H
        INX     D
        DCR     C
        JNZ     OSWP1
        RET

; OPTAB - addresses of the operations from 1 on.  It is left open: a file that
; comes next goes on with DW lines for QOWN, QOWN+1, ...
OPTAB:  DW      FADD,FSUB,FMUL,FDIV
        DW      OJN,OJZ,ODRP
        DW      XSIG,XMAX,XE6N
        DW      OJMP,ORET
        DW      ODUP,OOVR,OSWP,OSQ,ODBL
        DW      FNEG,FFLR,FSQR
        DW      FSIN,FCOS,FTG,FATG
        DW      FABS
