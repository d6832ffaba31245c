; float.asm - numbers of 40 bits
; Offers: FADD FSUB FMUL FDIV FNEG FABS FCMP FSGN FITOF FTOI16
; Uses:   FWORK, ERROR (RST 1)
; Room:   1500 bytes
;
;   byte    0          1          2          3          4
;       +--------+ +--------+ +--------+ +--------+ +--------+
;       |exponent| |s  m3   | |   m2   | |   m1   | |   m0   |
;       +--------+ +--------+ +--------+ +--------+ +--------+
;
; value = (-1)^s * 0.1mmm...m (binary, 32 bits) * 2^(exponent-128)
;
; The first bit of the mantissa is always 1 and is not kept: the sign stands in
; its place.  Exponent 0 is the number zero; all its bytes are zero, there is no
; negative zero.  Examples: 1 = 81 00 00 00 00, -0.5 = 80 80 00 00 00.
;
; Range: 2^-128 = 2.9E-39 to 2^127*(2-2^-31) = 1.7E38, 9.6 digits.  A result below
; becomes 0 (the test is made before rounding), a result above is ERR 05.
; Rounding: to nearest, halves away from zero.
;
; Rule of calling: FADD FSUB FMUL FDIV take DE -> x and HL -> y and leave the result
; in x; x and y may be the same.  Functions of one number take HL -> x and leave
; the result there.  All registers are lost unless said otherwise.
;
; Inside, a mantissa stands in B C D E with its first bit 1 and a guard byte in L
; behind it; H = exponent, bit 7 of SIGN = sign, the address of the result on the
; 8080 stack.

SIGN    EQU FWORK+2     ; bit 7: sign of the result
EXPO    EQU FWORK+3     ; exponent of the result
SHIFT   EQU FWORK+4     ; difference of exponents
FY      EQU FWORK+5     ; mantissa of y, low byte first
FQ      EQU FWORK+9     ; byte of the quotient that grows
FT      EQU FWORK+10    ; bytes 1...3 of a partial product

; FSUB - x - y
; FADD - x + y
; In:  DE -> x, HL -> y   Out: x; ERR 05   Clobbers all
FSUB:   MVI     A,80H           ; turns the sign of y
        DB      0FEH            ; CPI: skips the XRA
FADD:   XRA     A
        MOV     C,A             ; C = turn in y's sign
        PUSH    D
        MVI     B,0             ; B = turn in the larger one's
        LDAX    D
        SUB     M
        XCHG
        JNC     FADD1           ; HL -> x is the larger, DE -> y
        XCHG
        MOV     B,C
        CMA
        INR     A
FADD1:  STA     SHIFT
        MOV     A,M
        STA     EXPO
        INX     H
        MOV     A,M
        XRA     B
        STA     SIGN
        LDAX    D
        ORA     A
        JZ      FADD4           ; nothing to add
        INX     D
        LDAX    D
        XRA     M
        XRA     C               ; S: signs differ
        PUSH    H
        PUSH    PSW
        XCHG
        CALL    FLOAD
        LDA     SHIFT
        CALL    FSHR            ; B C D E L = the smaller, aligned
        POP     PSW
        MOV     A,L
        POP     H
        INX     H
        INX     H
        INX     H               ; HL -> low byte of the larger
        JM      FADD2
        PUSH    PSW             ; guard
        MOV     A,E
        ADD     M
        MOV     E,A
        DCX     H
        MOV     A,D
        ADC     M
        MOV     D,A
        DCX     H
        MOV     A,C
        ADC     M
        MOV     C,A
        DCX     H
        MOV     A,M
        RAL
        STC
        RAR                     ; first bit 1 for the sign, CY kept
        ADC     B
        MOV     B,A
        POP     H
        MOV     L,H             ; guard
        LDA     EXPO
        JNC     FRNDA
        MVI     H,1
        CALL    FSHR2           ; carry comes in
        LDA     EXPO
        INR     A
        JZ      FOVF
FRNDA:  MOV     H,A
        JMP     FRND

FADD2:  CMA                     ; 0 - guard
        ADI     1
        CMC
        PUSH    PSW
        MOV     A,M
        SBB     E
        MOV     E,A
        DCX     H
        MOV     A,M
        SBB     D
        MOV     D,A
        DCX     H
        MOV     A,M
        SBB     C
        MOV     C,A
        DCX     H
        MOV     A,M
        RAL
        STC
        RAR
        SBB     B
        MOV     B,A
        POP     H
        MOV     L,H
        JNC     FADD3
        XRA     A               ; it was the smaller after all: turn all (guard is 0)
        SUB     E
        MOV     E,A
        MVI     A,0
        SBB     D
        MOV     D,A
        MVI     A,0
        SBB     C
        MOV     C,A
        MVI     A,0
        SBB     B
        MOV     B,A
        LDA     SIGN
        CMA
        STA     SIGN
FADD3:  LDA     EXPO
        MOV     H,A
        JMP     FNRM

FADD4:  CALL    FLOAD
        LDA     EXPO
        MOV     H,A
        JMP     FPACK

; FLOAD - takes a mantissa
; In:  HL -> byte 1   Out: B C D E, HL -> byte 4   Clobbers A
FLOAD:  MOV     A,M
        ORI     80H
        MOV     B,A
        INX     H
        MOV     C,M
        INX     H
        MOV     D,M
        INX     H
        MOV     E,M
        RET

; FSHR - shifts a mantissa right
; In:  B C D E, A = bits   Out: B C D E L, bit 0 of L also set when a 1 was lost
; Clobbers A, H
FSHR:   PUSH    PSW
        MVI     L,0
        ANI     7
        MOV     H,A
        CNZ     FSHR1
        POP     PSW
FSHR3:  SUI     8
        RC
        MOV     H,A
        MOV     A,L
        ADI     0FFH            ; CY: something is lost
        MOV     A,E
        JNC     FSHR4
        ORI     1
FSHR4:  MOV     L,A
        MOV     E,D
        MOV     D,C
        MOV     C,B
        MVI     B,0
        MOV     A,H
        JMP     FSHR3

; FSHR2 - shifts H bits, CY comes in first
FSHR1:  ORA     A
FSHR2:  MOV     A,B
        RAR
        MOV     B,A
        MOV     A,C
        RAR
        MOV     C,A
        MOV     A,D
        RAR
        MOV     D,A
        MOV     A,E
        RAR
        MOV     E,A
        MOV     A,L
        RAR
        MOV     L,A
        DCR     H
        JNZ     FSHR1
        RET

; FMUL - x * y
; In:  DE -> x, HL -> y   Out: x; ERR 05   Clobbers all
FMUL:   PUSH    D
        MOV     A,M
        ORA     A
        JZ      FZERO
        LDAX    D
        SUI     1
        JC      FZERO
        ADD     M               ; CY,A = exponents + 127
        CALL    FEXP
        PUSH    B
        LXI     B,0
        CALL    FMUL1           ; low half of x * y
        POP     D
        PUSH    B
        LHLD    FT+1
        MOV     B,H
        MOV     C,L
        CALL    FMUL1           ; high half * y + carry
        LHLD    FT+1
        POP     D
        DAD     D
        XCHG
        JNC     FMULA
        INX     B
FMULA:  LHLD    FT              ; L = guard
        JMP     FNRM1

; FMUL1 - 16 * 32 bits
; In:  DE, FY, BC = added   Out: BC, FT+2, FT+1, FT = product without its low byte
FMUL1:  LDA     FY
        CALL    FMUL2
        LDA     FY+1
        CALL    FMUL2
        STA     FT
        LDA     FY+2
        CALL    FMUL2
        STA     FT+1
        LDA     FY+3
        CALL    FMUL2
        STA     FT+2
        RET

; FMUL2 - 8 * 16 bits
; In:  A, DE, BC = added   Out: BC, A = low byte of the product   Clobbers HL
; Cycles: 310 on average
FMUL2:  ADD     A
        LXI     H,0
        JNC     FMUL3
        MOV     H,D
        MOV     L,E
FMUL3:  DAD     H
        RAL
        JNC     FMUL4
        DAD     D
        ACI     0
FMUL4:  DAD     H
        RAL
        JNC     FMUL5
        DAD     D
        ACI     0
FMUL5:  DAD     H
        RAL
        JNC     FMUL6
        DAD     D
        ACI     0
FMUL6:  DAD     H
        RAL
        JNC     FMUL7
        DAD     D
        ACI     0
FMUL7:  DAD     H
        RAL
        JNC     FMUL8
        DAD     D
        ACI     0
FMUL8:  DAD     H
        RAL
        JNC     FMUL9
        DAD     D
        ACI     0
FMUL9:  DAD     H
        RAL
        JNC     FMULB
        DAD     D
        ACI     0
FMULB:  DAD     B
        ACI     0
        MOV     B,A
        MOV     C,H
        MOV     A,L
        RET

; FEXP - sign and exponent of a product or quotient, mantissas
; In:  DE -> x, HL -> y, CY,A = exponent of the result + 128
; Out: SIGN, EXPO; B C D E = mantissa of x, FY = that of y
;      (out of range: leaves the routine that called it)
FEXP:   MOV     B,A
        RAR                     ; CY,A from 80H to 17FH: the first two bits differ
        ADI     40H
        JP      FEXP1
        MOV     A,B
        XRI     80H
        STA     EXPO
        INX     D
        INX     H
        LDAX    D
        XRA     M
        STA     SIGN
        PUSH    D
        CALL    FLOAD
        XCHG
        SHLD    FY
        MOV     H,B
        MOV     L,C
        SHLD    FY+2
        POP     H
        JMP     FLOAD
FEXP1:  POP     H
        JNC     FZERO
FOVF:   RST     1
        DB      ERANGE

; FDIV - x / y
; In:  DE -> x, HL -> y   Out: x; ERR 05 too when y is 0   Clobbers all
FDIV:   PUSH    D
        MOV     A,M
        ORA     A
        JZ      FOVF
        LDAX    D
        ORA     A
        JZ      FZERO
        SUB     M
        CMC                     ; CY,A = exponents + 256
        CALL    FEXP
        MVI     A,1
        STA     FQ
        CALL    FDIV3           ; first bit: is x >= y?
        PUSH    PSW
        CALL    FDIV1
        PUSH    PSW
        CALL    FDIV1
        PUSH    PSW
        CALL    FDIV1
        PUSH    PSW
        MVI     A,40H
        CALL    FDIVA           ; two bits more
        RRC
        RRC
        MOV     L,A             ; guard
        POP     D
        MOV     E,D
        POP     PSW
        MOV     D,A
        POP     B
        MOV     C,B
        POP     PSW
        MOV     B,A
        JMP     FNRM1

; FDIV1 - eight bits of the quotient
; In:  B C D E = remainder, FY = divisor   Out: A, B C D E   Clobbers HL
FDIV1:  MVI     A,1             ; ready when this bit comes out
FDIVA:  STA     FQ
FDIV2:  MOV     A,E
        ADD     A
        MOV     E,A
        MOV     A,D
        RAL
        MOV     D,A
        MOV     A,C
        RAL
        MOV     C,A
        MOV     A,B
        RAL
        MOV     B,A
        JC      FDIV5
FDIV3:  LXI     H,FY+3
        MOV     A,B
        CMP     M
        JNZ     FDIV4
        DCX     H
        MOV     A,C
        CMP     M
        JNZ     FDIV4
        DCX     H
        MOV     A,D
        CMP     M
        JNZ     FDIV4
        DCX     H
        MOV     A,E
        CMP     M
FDIV4:  JC      FDIV6           ; smaller: bit 0
FDIV5:  LXI     H,FY
        MOV     A,E
        SUB     M
        MOV     E,A
        INX     H
        MOV     A,D
        SBB     M
        MOV     D,A
        INX     H
        MOV     A,C
        SBB     M
        MOV     C,A
        INX     H
        MOV     A,B
        SBB     M
        MOV     B,A
        ORA     A
FDIV6:  CMC
        LXI     H,FQ
        MOV     A,M
        RAL
        MOV     M,A
        JNC     FDIV2
        RET

; FNRM1 - ends FMUL and FDIV
; In:  B C D E L = mantissa from 1/4 up, EXPO for one below 1/2
FNRM1:  LDA     EXPO
        INR     A
        MOV     H,A
        MOV     A,B
        ORA     A
        JP      FNRM2
        MOV     A,H
        ORA     A
        JZ      FOVF
        JMP     FRND

; FNRM - normalizes, rounds and stores
; In:  B C D E L = any mantissa, H = exponent, SIGN; on the stack: address
FNRM:   MOV     A,B
        ORA     A
        JM      FRND
        JNZ     FNRM2
        MOV     B,C             ; a byte at a time
        MOV     C,D
        MOV     D,E
        MOV     E,L
        MVI     L,0
        MOV     A,H
        SUI     8
        MOV     H,A
        JC      FZERO
        JNZ     FNRM
        JMP     FZERO
FNRM2:  MOV     A,L
        ADD     A
        MOV     L,A
        MOV     A,E
        RAL
        MOV     E,A
        MOV     A,D
        RAL
        MOV     D,A
        MOV     A,C
        RAL
        MOV     C,A
        MOV     A,B
        RAL
        MOV     B,A
        DCR     H
        JZ      FZERO
        ORA     A
        JP      FNRM2
; (fall into FRND)

; FRND - rounds and stores
; In:  B C D E L = mantissa, H = exponent, SIGN; on the stack: address
FRND:   MOV     A,L
        ADD     A
        JNC     FPACK
        INR     E
        JNZ     FPACK
        INR     D
        JNZ     FPACK
        INR     C
        JNZ     FPACK
        INR     B
        JNZ     FPACK
        MVI     B,80H
        INR     H
        JNZ     FPACK
        JMP     FOVF

FZERO:  LXI     B,0
        MOV     D,B
        MOV     E,B
        MOV     H,B
; (fall into FPACK)

; FPACK - stores
; In:  B C D E = mantissa (0: zero), H = exponent, SIGN; on the stack: address
; Out: HL -> last byte of the result   Clobbers A
FPACK:  MOV     A,H
        POP     H
        MOV     M,A
        INX     H
        LDA     SIGN
        ORI     7FH
        ANA     B               ; sign for the first bit
        MOV     M,A
        INX     H
        MOV     M,C
        INX     H
        MOV     M,D
        INX     H
        MOV     M,E
        RET

; FNEG - -x
; In:  HL -> x   Out: x   Clobbers A, HL
FNEG:   MOV     A,M
        ORA     A
        RZ
        INX     H
        MOV     A,M
        XRI     80H
        MOV     M,A
        RET

; FABS - |x|
; In:  HL -> x   Out: x   Clobbers A, HL
FABS:   INX     H
        MOV     A,M
        ANI     7FH
        MOV     M,A
        RET

; FSGN - sign of x
; In:  HL -> x   Out: A = 0, 1 or 0FFH, flags of it   Clobbers nothing else
FSGN:   MOV     A,M
        ORA     A
        RZ
        INX     H
        MOV     A,M
        DCX     H
        RLC
        SBB     A
        ORI     1
        RET

; FCMP - compares
; In:  DE -> x, HL -> y   Out: Z: x = y; CY: x < y   Clobbers A, B, C, DE, HL
FCMP:   INX     D
        INX     H
        LDAX    D
        MOV     B,A             ; bit 7: sign of x
        XRA     M
        MOV     A,B
        JM      FCMP2           ; signs differ
        DCX     D
        DCX     H
        MVI     C,5
FCMP1:  LDAX    D
        CMP     M
        INX     D
        INX     H
        JNZ     FCMP3
        DCR     C
        JNZ     FCMP1
        RET
FCMP3:  SBB     A               ; 0FFH: |x| < |y|
        XRA     B
FCMP2:  ORI     1
        RLC
        RET

; FITOF - whole number to float
; In:  HL = 0...65535, DE -> float   Clobbers all
FITOF:  PUSH    D
        MOV     B,H
        MOV     C,L
        LXI     D,0
        XRA     A
        STA     SIGN
        LXI     H,9000H         ; exponent of 2^16
        JMP     FNRM

; FTOI16 - float to whole number
; In:  HL -> x   Out: HL = x; CY: it is negative, not whole or above 65535
; Clobbers all
FTOI16: MOV     A,M
        ORA     A
        JNZ     FTOI1
        MOV     H,A
        MOV     L,A
        RET
FTOI1:  MVI     A,0A0H
        SUB     M               ; bits behind the units
        RC
        CPI     10H
        RC
        MOV     B,A
        INX     H
        MOV     A,M
        RLC
        RC
        PUSH    B
        CALL    FLOAD
        POP     PSW
        CALL    FSHR
        MOV     A,L
        ADI     0FFH            ; CY: not whole
        XCHG
        RET

; Still to come; until then ERR 05
FSQR:
FSIN:
FCOS:
FTG:
FATG:
FFLR:
DECIN:
DECOUT: JMP     FOVF
