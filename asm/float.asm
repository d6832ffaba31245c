; float.asm - numbers of 40 bits
; Offers: FSUB FADD OSQ FMUL FDIV FABS FNEG FSGN FITOF FTOI16 FWHOLE FFLR FSQR FTG FCOS FSIN FATG
; Uses:   calc consts start
; Room:   1087 bytes
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
; To compare, subtract: FSUB and FSGN, or QSUB and QJN, QJZ on the calculator.
;
; Inside, a mantissa stands in B C D E with its first bit 1 and a guard byte in L
; behind it; H = exponent, bit 7 of SIGN = sign, the address of the result on the
; 8080 stack.

FY      EQU FWORK       ; mantissa of y, or Z of FSER, low byte first
FQ      EQU FWORK+4     ; byte of the quotient that grows
FT      EQU FWORK+5     ; bytes 1 and 2 of a partial product; mask of FSQR
SIGN    EQU FWORK+7     ; bit 7: sign of the result
EXPO    EQU FWORK+8     ; exponent of the result
SHIFT   EQU FWORK+9     ; difference of exponents
ODD     EQU FWORK+10    ; bit 0: what FFLR found is odd
                        ; (35 bytes are free, then comes FSP)

;! FWORK & 0FFH == 80H -- FSQR knows by the low address that it has passed FY+1
;! FQ == FY+4 and FT == FQ+1 and SIGN == FT+2 -- FSQR stores FQ and FT at once, FMANT a word at FT

; FSUB - x - y
; FADD - x + y
; In:  DE -> x, HL -> y   Out: x; ERR 05   Clobbers all
FSUB:   MVI     A,80H           ; turns the sign of y
        DB      SKIP1           ; skips the XRA
FADD:   XRA     A
        MOV     C,A             ; C = turn in y's sign
        MOV     A,M
        ORA     A
        RZ                      ; nothing to add
        PUSH    D
        MVI     B,0             ; B = turn in the larger one's
        LDAX    D
        SUB     M
        JNC     FADD1
        MOV     B,C
        CMA
        INR     A
        DB      SKIP1           ; skips the XCHG
FADD1:  XCHG                    ; HL -> the larger, DE -> the smaller
        STA     SHIFT
        MOV     A,M
        STA     EXPO
        INX     H
        MOV     A,M
        XRA     B
        STA     SIGN
        LDAX    D
        ORA     A
        JZ      FADD4           ; nothing to add to
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
        JNC     FNRME
        MVI     H,1
        CALL    FSHR2           ; carry comes in
        STC
; (fall into FNRMC)

; FNRMC - ends FADD after a carry, FMUL and FDIV
; In:  B C D E L = mantissa, EXPO one less than for a first bit 1, CY = first bit; the rest as FNRM
; Out: as FNRM   Clobbers all
FNRMC:  LDA     EXPO
        INR     A
        MOV     H,A
        JNC     FNRM2
        JNZ     FRND
        DB      ERROR,ERANGE

FADD4:  CALL    FLOAD           ; FADD: 0 to add to: the other number, packed
        MVI     L,0
        JMP     FNRME

; OSQ - QSQ: x * x (an operation of the calculator)
; In:  HL -> x   Out: x; ERR 05   Clobbers all
OSQ:    MOV     D,H
        MOV     E,L
; (fall into FMUL)

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
        CALL    FMANT
; (fall into FNRM1)

; FNRM1 - ends FMUL and FDIV
; In:  B C D E L = mantissa from 1/4 up, EXPO for one below 1/2; the rest as FNRM   Out: as FNRM   Clobbers all
FNRM1:  MOV     A,B
        RLC
        JMP     FNRMC

; FMANT - product of two mantissas or fractions
; In:  B C D E, FY   Out: B C D E L = product, cut off   Clobbers A, H
; Cycles: 2,800, 500 less for every byte of FY that is 0
;
; The mantissa in halves, xh in BC and xl in DE, each times y; byte by byte:
;
;         xl * y            p5 p4 p3 p2 p1 p0
;         xh * y      q5 q4 q3 q2 q1 q0
;                     B  C  D  E  L
;
; p3 p2 go into the second product as its carry; p5 p4 are added to q3 q2 behind it; p1 p0 and
; what becomes of q0 are cut off.
FMANT:  PUSH    B
        LXI     B,0
        CALL    FMUL1           ; low half * y
        POP     D
        PUSH    B
        MOV     B,A
        LDA     FT+1
        MOV     C,A
        CALL    FMUL1           ; high half * y + carry
        MOV     H,A
        LDA     FT+1
        MOV     L,A
        POP     D
        DAD     D
        XCHG
        LHLD    FT              ; L = guard
        RNC
        INX     B
        RET

; FMUL1 - 16 * 32 bits
; In:  DE, FY, BC = added   Out: BC, A, FT+1, FT = product without its low byte
; Clobbers HL
FMUL1:  LDA     FY
        CALL    FMUL2
        LDA     FY+1
        CALL    FMUL2
        STA     FT
        LDA     FY+2
        CALL    FMUL2
        STA     FT+1
        LDA     FY+3
; (fall into FMUL2)

; FMUL2 - 8 * 16 bits
; In:  A, DE, BC = added   Out: BC, A = low byte of the product   Clobbers HL
; Cycles: 313, for A = 0 66
FMUL2:  LXI     H,0
        ORA     A
        JZ      FMULB           ; many a float ends in bytes of zeros
        RAL                     ; a bit at a time, the first one simpler
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
;      (out of range: leaves the routine that called it)   Clobbers A, HL
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
        CALL    FSTY
        POP     H
; (fall into FLOAD)

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

; FSTY - stores a mantissa
; In:  B C D E   Out: FY   Clobbers DE, HL
FSTY:   XCHG
        SHLD    FY
        MOV     H,B
        MOV     L,C
        SHLD    FY+2
        RET

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
        CALL    FDIVX
        PUSH    H
        MVI     A,1
FDIV0:  CALL    FDIVW           ; (FSQR comes in here)
        PUSH    H
        MVI     A,40H
        CALL    FDIVA           ; two bits more
        RRC
        RRC
        MOV     L,A             ; guard
        POP     D
        POP     B
        JMP     FNRM1

; FDIVW - 16 bits of the quotient, fewer by those that A has above its highest 1
; FDIVX - the same when the first eight are in A
; In:  B C D E = remainder, FY = divisor   Out: HL, B C D E   Clobbers A
FDIVW:  CALL    FDIVA
FDIVX:  PUSH    PSW
        CALL    FDIV1
        POP     H
        MOV     L,A
        RET

; FDIV1 - eight bits of the quotient
; FDIVA - as many as A has zeros above its highest 1, and one: 40H two bits
; In:  B C D E = remainder, FY = divisor   Out: A, B C D E, CY set   Clobbers HL
; Cycles: 210 a bit
FDIV1:  MVI     A,1             ; ready when this bit comes out
FDIVA:  STA     FQ
FDIV2:  XCHG
        DAD     H
        XCHG
        MOV     A,C
        RAL
        MOV     C,A
        MOV     A,B
        RAL
        MOV     B,A
        JC      FDIV5           ; 2^32 and more: it goes
FDIV3:  LHLD    FY
        MOV     A,E
        SUB     L
        MOV     A,D
        SBB     H
        LHLD    FY+2
        MOV     A,C
        SBB     L
        MOV     A,B
        SBB     H
        JC      FDIV6           ; smaller: bit 0
FDIV5:  LHLD    FY
        MOV     A,E
        SUB     L
        MOV     E,A
        MOV     A,D
        SBB     H
        MOV     D,A
        LHLD    FY+2
        MOV     A,C
        SBB     L
        MOV     C,A
        MOV     A,B
        SBB     H
        MOV     B,A
        ORA     A
FDIV6:  CMC
        LXI     H,FQ
        MOV     A,M
        RAL
        MOV     M,A
        JNC     FDIV2
        RET

; FADD2 - the part of FADD for different signs
; In:  B C D E A = the smaller, aligned, HL -> last byte of the larger, EXPO; the rest as FNRM   Out: as FNRM   Clobbers all
FADD2:  ADI     0FFH            ; 0 - guard, CY: borrow
        CMA
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
        JNC     FNRME
        XRA     A               ; it was the smaller after all: turn all (the guard L is 0)
        SUB     E
        MOV     E,A
        MOV     A,L
        SBB     D
        MOV     D,A
        MOV     A,L
        SBB     C
        MOV     C,A
        MOV     A,L
        SBB     B
        MOV     B,A
        LDA     SIGN
        CMA
        STA     SIGN
; (fall into FNRME)

; FNRME - as FNRM, exponent in EXPO
; Clobbers all
FNRME:  LDA     EXPO
        MOV     H,A
; (fall into FNRM)

; FNRM - normalizes, rounds and stores
; In:  B C D E L = any mantissa, H = exponent, SIGN; on the stack: address   Out: as FPACK; ERR 05   Clobbers all
FNRM:   MOV     A,B
        ORA     A
        JM      FRND
        ORA     C
        ORA     D
        ORA     E
        ORA     L
        JZ      FZERO
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
        DCR     H               ; (CY stays)
        JZ      FZERO
        MOV     A,B
        ADC     A
        MOV     B,A
        JP      FNRM2
; (fall into FRND)

; FRND - rounds and stores
; In:  B C D E L = mantissa, H = exponent, SIGN; on the stack: address   Out: as FPACK; ERR 05   Clobbers all
FRND:   MOV     A,L
        ADD     A
        JNC     FPACK
        INX     D
        MOV     A,D
        ORA     E
        JNZ     FPACK
        INX     B
        MOV     A,B
        ORA     C
        JNZ     FPACK
        MVI     B,80H
        INR     H
        JNZ     FPACK
; (fall into FOVF)

FOVF:   DB      ERROR,ERANGE

FEXP1:  POP     H               ; exponent out of range: drops the return to FMUL, FDIV
        JC      FOVF
FZERO:  LXI     B,0             ; (FMUL, FDIV and FNRM come in here)
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

; FABS - |x|
; FNEG - -x
; In:  HL -> x   Out: x   Clobbers A
FABS:   CALL    FSGN
        RP
FNEG:   MOV     A,M
        ORA     A
        RZ
        INX     H
        MOV     A,M
        XRI     80H
        MOV     M,A
        DCX     H
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

; FITOF - whole number to float
; In:  HL = 0...65535, DE -> float   Clobbers all
FITOF:  PUSH    D
        XCHG
        LXI     B,0
        XRA     A
        STA     SIGN
        JMP     FFLR1

; FTOI16 - float to whole number
; In:  HL -> x   Out: HL = x; CY: it is negative, not whole or above 65535
; Clobbers all
FTOI16: MOV     A,M
        ORA     A
        MOV     D,A
        MOV     E,A
        XCHG
        RZ
        XCHG
        CALL    FWHOLE
        LDA     SIGN
        ANI     80H
        ORA     B
        ORA     C
        ORA     L
        ADI     0FFH            ; CY: any of these
        XCHG
        RET

; FWHOLE - whole part of a number
; In:  HL -> x, not 0   Out: B C D E = |x| cut off, L = 0 when that is x, SIGN
;      (2^32 and more: B C D E = 0, L = 1)   Clobbers A, H
FWHOLE: MVI     A,0A0H
; FALIGN - the same for x * 2^(A-0A0H)   Clobbers A, H
FALIGN: SUB     M               ; bits behind the units (too large: at least 161)
        PUSH    PSW
        INX     H
        MOV     A,M
        STA     SIGN
        CALL    FLOAD
        POP     PSW
; (fall into FSHR)

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
        XRA     A
        CMP     L               ; CY: something is lost
        RAL
        ORA     E
        MOV     L,A
        MOV     E,D
        MOV     D,C
        MOV     C,B
        MVI     B,0
        MOV     A,H
        JMP     FSHR3

; FSHR1 - shifts a mantissa right by H bits, zeros come in.  FSHR2 - CY comes in first
; In:  B C D E L, H from 1 up   Out: B C D E L, H = 0   Clobbers A
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

; FFLR - greatest whole number not above x
; In:  HL -> x   Out: x   Clobbers all
FFLR:   MOV     A,M
        CPI     0A0H
        RNC                     ; large ones are whole
        PUSH    H
        CALL    FWHOLE
        LDA     SIGN
        ADD     A
        SBB     A
        ANA     L
        JZ      FFLR1
        INX     D               ; negative and not whole: one up
        MOV     A,D
        ORA     E
        JNZ     FFLR1
        INX     B
FFLR1:  MOV     A,E             ; (FITOF comes in here)
        STA     ODD
        LXI     H,0A000H
        JMP     FNRM

; FSQR - square root
; In:  HL -> x   Out: x; ERR 05 when it is negative   Clobbers all
;
; Bit by bit.  With Q the root so far and t half of the bit to be found, the step
; is FDIV's with the divisor Q + t: subtract when it goes, then the bit belongs to
; Q.  The bits from the 24th on, together d, are what is left over 2Q + d.  There FDIV goes
; on with one divisor: Q + 2^-24 is right for d = 0 and for the greatest d, so that next to
; whole numbers all is exact; for those between the root is up to 2^-49 too small.
;
; What it borrows of FDIV: FDIV2 doubles the remainder, then takes a step; FDIV3 takes it without
; doubling (an odd exponent's first bit); both return where FQ's mark comes out, to FSQR2, which
; stands on the stack.  FDIVA is FDIV2 with the mark set, one bit for 80H.  FDIV0 finds the bits
; from the 24th on, rounds and stores, as for a quotient.
FSQR:   MOV     A,M
        ORA     A
        RZ
        PUSH    H
        ADI     1
        RAR
        PUSH    PSW             ; CY set: even exponent
        ADI     3FH
        STA     EXPO
        INX     H
        MOV     A,M
        STA     SIGN
        RLC
        JC      FOVF
        CALL    FLOAD
        LXI     H,0
        SHLD    FY
        MVI     H,0A0H          ; Q = 1/2, t = 1/8
        SHLD    FY+2
        LXI     H,2080H         ; one bit, t = 20H of the first byte
        SHLD    FQ
        MOV     A,B
        SUI     40H
        MOV     B,A             ; even: x - 1/4, to be doubled
        POP     PSW
        LXI     H,FY+3
        PUSH    H
        LXI     H,FSQR2
        PUSH    H
        JC      FDIV2
        MOV     A,B
        SUI     40H
        MOV     B,A             ; odd: 2 * (x/2 - 1/4)
        JMP     FDIV3
FSQR1:  STA     FT              ; A = t, HL -> its byte
        ORA     M
        MOV     M,A
        PUSH    H
        MVI     A,80H
        CALL    FDIVA
FSQR2:  POP     H
        RRC                     ; CY = the bit
        LDA     FT
        JNC     FSQR3
        ADD     M               ; t + t: the bit of Q
        JNC     FSQR4
        INX     H
        INR     M
        DCX     H
        DB      SKIP1           ; skips the XRA
FSQR3:  XRA     M
FSQR4:  MOV     M,A
        LDA     FT
        RRC
        JNC     FSQR1
        DCR     L               ; the next byte, FY+2 or FY+1, not FY: its low address is 80H,
        CMP     L               ; as A is (a Z80 has no parity after DCR)
        JNZ     FSQR1
        INX     H
        INR     M               ; Q + 2^-24
        MOV     A,M
        STC
        RAR                     ; seven bits are there, the lowest one is to come
        LHLD    FY+2
        PUSH    H
        JMP     FDIV0           ; FDIV finds it and the others

; Functions of angles, in degrees: x is on top of the calculator's stack, the result takes its place.

; FTG - tangent, sine by cosine
; In:  HL -> x   Out: x; ERR 05 for odd multiples of 90   Clobbers all
FTG:    DB      CALC,QDUP,QSIN,QSWP,QCOS,QDIV+QRET ; tan x

; FCOS - cosine
; In:  HL -> x   Out: x; ERR 05 as FSIN   Clobbers all
FCOS:   DB      CALC,QABS,QNEG,Q90,QADD ; 90-|x|
        DB      QSIN+QRET               ; cos x

; FSIN - sine
; In:  HL -> x   Out: x; ERR 05 from 2^33 on, where the turns are too many to count
; Clobbers all
FSIN:   MOV     A,M
        CPI     0A2H
        JNC     FOVF
        DB      CALC,QDUP,QI180,QMUL    ; x x/180
        DB      QHALF,QADD,QFLR         ; x k           k half turns
        DB      Q90,QMUL,QDBL,QSUB      ; r             -90...90
        DB      QI64,QMUL,QEND          ; r/64
        LDA     ODD
        RRC
        JNC     FSIN1
        DB      CALC,QNEG,QEND          ; after an odd number of them: the other way
FSIN1:  LXI     D,CSIN
; (fall into FSER)

; FSER - y + y*P(y*y): that way the error of the polynomial P hardly counts
; In:  y on the calculator's stack, DE -> table   Out: the sum instead of y   Clobbers all
;
; P(z) = c1 - z*Q(z).  Q is computed with fractions of 32 bits, by
; s = coefficient - Z*s, where Z = z / 2^e is below 1; s stays between 0 and 1.  The
; table: c1, a float; 80H+e; the coefficients times 2^e, 2^2e ..., the highest power's
; first, low byte first and odd; 80H-e, which is even.
FSER:   CALL    OOVR            ; y c1
        INX     D
        PUSH    D
        DB      CALC,QOVR,QSQ,QDUP,QEND ; y c1 z z
        POP     D
        CALL    FSER1           ; y c1 z Q
        DB      CALC,QMUL,QSUB  ; y P
        DB      QOVR,QMUL,QADD+QRET     ; y+y*P

; FSER1 - z to Q(z), on top of the calculator's stack
; In:  DE -> table from 80H+e on   Clobbers all
FSER1:  LHLD    FSP
        PUSH    H               ; -> z, for FNRM
        LDAX    D
        INX     D
        PUSH    D
        CALL    FALIGN
        CALL    FSTY            ; FY = Z
        POP     H
        XRA     A               ; Z*s = 0 to begin with
        MOV     B,A
        MOV     C,A
        MOV     D,A
        MOV     E,A
FSER2:  MOV     A,M             ; s = coefficient - Z*s - CY
        SBB     E
        MOV     E,A
        INX     H
        MOV     A,M
        SBB     D
        MOV     D,A
        INX     H
        MOV     A,M
        SBB     C
        MOV     C,A
        INX     H
        MOV     A,M
        SBB     B
        MOV     B,A
        INX     H
        MOV     A,M
        RRC
        JNC     FSER3
        PUSH    H
        CALL    FMANT
        MOV     A,L             ; rounds
        ADD     A
        POP     H
        JMP     FSER2
FSER3:  MOV     H,M             ; exponent: Q = s / 2^e
        MVI     L,0             ; guard (the table's last coefficient counts on it)
        JMP     FNRM            ; (SIGN is z's)

; sin(64 y) for |y| <= 90/64, to 2^-35; the last coefficient is one less than the best, so
; that 30 and 90 degrees come out exactly
CSIN:   DB      07DH,06FH,0A3H,051H,029H        ; 0.1170107213
        DB      082H
        DB      049H,06AH,005H,000H             ; 8.262902789e-5
        DB      03DH,004H,07DH,000H             ; 0.001907601364
        DB      0E3H,099H,00DH,007H             ; 0.02755128654
        DB      0BDH,028H,05BH,03BH             ; 0.2318597277
        DB      061H,010H,0DCH,0EDH             ; 0.9291391598
        DB      07EH
; 64*atan(y/64) for |y| <= 32, to 2^-32
CATG:   DB      07DH,0D6H,088H,0F9H,06FH        ; -0.1047534453
        DB      08CH
        DB      07DH,00CH,0C5H,008H             ; 0.03425672548
        DB      037H,0FAH,036H,012H             ; 0.07115138848
        DB      03DH,0B1H,00CH,019H             ; 0.0978499194
        DB      061H,09EH,0B4H,020H             ; 0.1277560219
        DB      0CBH,0CFH,0D5H,02DH             ; 0.1790437573
        DB      02BH,0F4H,064H,04CH             ; 0.2984154325
        DB      074H

; FATG - arc tangent
; In:  HL -> x   Out: x, between -90 and 90   Clobbers all
FATG:   DB      CALC,QDUP,QABS,QEND     ; x s           s = |x|
        MOV     A,M                     ; (QABS leaves HL -> s)
        CPI     82H
        JNC     FATG2           ; from 2 up
        CPI     80H
        JNC     FATG1           ; from 1/2 up
        DB      CALC,Q0,QSWP,Q1         ; x 0 s 1
        DB      QJMP
        DB      FATG3-$
FATG1:  DB      CALC,Q90,QHALF,QMUL,QSWP ; x 45 s
        DB      QDUP,Q1,QSUB            ; x 45 s s-1
        DB      QSWP,Q1,QADD            ; x 45 s-1 s+1
        DB      QJMP
        DB      FATG3-$
FATG2:  DB      CALC,Q90,QSWP,QM1,QSWP  ; x 90 -1 s
FATG3:  DB      QI64,QMUL,QDIV,QEND     ; x base y      y = 64 times the quotient
        LXI     D,CATG
        CALL    FSER
        DB      CALC,QADD,QSWP,QSIG+QRET ; atan |x|, with the sign of x

FLTEND  EQU     $               ; (for the table of bytes)
