; float.asm - numbers of 40 bits
; Offers: FADD FSUB FMUL FDIV, FNEG FABS FSGN FFLR FSQR FSIN FCOS FTG FATG,
;         FITOF FTOI16, DECIN DECOUT
; Uses:   calc, start (ERROR PUTC DIGIT), lexer (LEXCH), io (PRDEC)
; Room:   1650 bytes
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

FY      EQU FWORK       ; mantissa of y, low byte first
FQ      EQU FWORK+4     ; byte of the quotient that grows
FT      EQU FWORK+5     ; bytes 1...3 of a partial product; mask of FSQR
FBIG    EQU FWORK       ; number of DECIN and DECOUT: 16 bytes whole, 22 bytes fraction
BIGEND  EQU FWORK+38
UNITS   EQU FBIG+15
DIGS    EQU FSTK+50     ; digits of DECOUT: 5 zeros, then 10
SIGN    EQU FWORK+43    ; bit 7: sign of the result
EXPO    EQU FWORK+44    ; exponent of the result
SHIFT   EQU FWORK+45    ; difference of exponents
POWER   EQU FWORK+45    ; digits of DECOUT before the point
FWEND   EQU FWORK+46    ; end of the cells, FSP follows

; FSUB - x - y
; FADD - x + y
; In:  DE -> x, HL -> y   Out: x; ERR 05   Clobbers all
FSUB:   MVI     A,80H           ; turns the sign of y
        DB      0FEH            ; CPI: skips the XRA
FADD:   XRA     A
        MOV     C,A             ; C = turn in y's sign
        MOV     A,M
        ORA     A
        RZ                      ; nothing to add
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
        LDA     EXPO
        INR     A
        MOV     H,A
        JNZ     FRND
        JMP     FOVF

FADD4:  CALL    FLOAD
        MVI     L,0
        JMP     FNRME

; FLOAD - takes a mantissa
; In:  HL -> byte 1   Out: B C D E, HL -> byte 4   Clobbers A
FLOAD:  MOV     A,M
        ORI     80H
FLOA1:  MOV     B,A
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
; (fall into FNRM1)

; FNRM1 - ends FMUL and FDIV
; In:  B C D E L = mantissa from 1/4 up, EXPO for one below 1/2
FNRM1:  MOV     A,B
        RLC
        LDA     EXPO
        INR     A
        MOV     H,A             ; H = exponent for a mantissa from 1/2 up
        JNC     FNRM2
        JNZ     FRND
        JMP     FOVF

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
; Cycles: 400, for A = 0 66
FMUL2:  LXI     H,0
        ORA     A
        JZ      FMUL6           ; many a float ends in bytes of zeros
        PUSH    B
        MVI     B,4
FMUL3:  DAD     H               ; two bits a turn
        RAL
        JNC     FMUL4
        DAD     D
        ACI     0
FMUL4:  DAD     H
        RAL
        JNC     FMUL5
        DAD     D
        ACI     0
FMUL5:  DCR     B
        JNZ     FMUL3
        POP     B
FMUL6:  DAD     B
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
; FDIVA - as many as A has zeros above its only 1, and one: 40H two bits
; In:  B C D E = remainder, FY = divisor   Out: A, B C D E, CY set   Clobbers HL
; Cycles: 210 a bit
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

; FADD2 - the part of FADD for different signs
; In:  B C D E A = the smaller, aligned, HL -> last byte of the larger
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
        JNC     FNRME
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
; (fall into FNRME)

; FNRME - as FNRM, exponent in EXPO
FNRME:  LDA     EXPO
        MOV     H,A
; (fall into FNRM)

; FNRM - normalizes, rounds and stores
; In:  B C D E L = any mantissa, H = exponent, SIGN; on the stack: address
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

FOVF:   RST     1
        DB      ERANGE

FEXP1:  POP     H               ; exponent out of range: drops the return to FMUL, FDIV
        JC      FOVF
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
FPAC1:  MOV     M,C
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
        JNZ     FTOI1
        MOV     H,A
        MOV     L,A
        RET
FTOI1:  CALL    FWHOLE
        CMC
        RC
        LDA     SIGN
        ANI     80H
        ORA     B
        ORA     C
        ORA     L
        ADI     0FFH            ; CY: any of these
        XCHG
        RET

; FWHOLE - whole part of a number
; In:  HL -> x, not 0   Out: CY set: B C D E = |x| cut off, L = 0 when that is x,
;      SIGN; CY clear: x is 2^32 or more   Clobbers A, H
FWHOLE: MVI     A,0A0H
        SUB     M               ; bits behind the units
        CMC
        RNC
        PUSH    PSW
        INX     H
        MOV     A,M
        STA     SIGN
        CALL    FLOAD
        POP     PSW
        JMP     FSHR

; FFLR - greatest whole number not above x
; In:  HL -> x   Out: x   Clobbers all
FFLR:   PUSH    H
        CALL    FWHOLE
        JNC     FFLR2
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
FFLR1:  LXI     H,0A000H
        JMP     FNRM
FFLR2:  POP     H
        RET

; FSQR - square root
; In:  HL -> x   Out: x; ERR 05 when it is negative   Clobbers all
;
; Bit by bit.  With Q the root so far and t half of the bit to be found, the step
; is FDIV's with the divisor Q + t: subtract when it goes, then the bit belongs to
; Q.  The last two bits come from a plain division by Q.
FSQR:   MOV     A,M
        ORA     A
        RZ
        PUSH    H
        ADI     1
        RAR
        PUSH    PSW             ; CY set: even exponent
        ADI     40H
        STA     EXPO
        INX     H
        MOV     A,M
        STA     SIGN
        RLC
        JC      FOVF
        CALL    FLOAD
        LXI     H,0
        SHLD    FY
        LXI     H,0A000H        ; Q = 1/2, t = 1/8
        SHLD    FY+2
        LXI     H,2080H         ; one bit, t = 20H of the first byte
        SHLD    FQ
        LXI     H,FY+3
        MOV     A,B
        SUI     40H
        MOV     B,A             ; even: x - 1/4, to be doubled
        POP     PSW
        PUSH    H
        LXI     H,FSQR2
        PUSH    H
        JC      FDIV2
        MOV     A,B
        SUI     40H
        MOV     B,A             ; odd: 2 * (x/2 - 1/4)
        JMP     FDIV3
FSQR1:  STA     FT              ; A = t, HL -> its byte
        PUSH    H
        ORA     M
        MOV     M,A
        MVI     A,80H
        CALL    FDIVA
FSQR2:  POP     H
        RRC
        LDA     FT
        JNC     FSQR3
        ADD     M               ; t + t: the bit of Q
        JNC     FSQR4
        INX     H
        INR     M
        DCX     H
        DB      0FEH            ; CPI: skips the XRA
FSQR3:  XRA     M
FSQR4:  MOV     M,A
        LDA     FT
        RRC
        JNC     FSQR1
        DCX     H
        MOV     A,L
        CPI     (FY-1)&255
        MVI     A,80H
        JNZ     FSQR1
        MVI     A,40H
        CALL    FDIVA
        RRC                     ; bit 0: last bit, bit 7: the one behind it
        LHLD    FY+2
        MOV     B,H
        MOV     C,L
        LHLD    FY
        XCHG
        MOV     L,A
        ANI     1
        ORA     E
        MOV     E,A
        JMP     FNRME

; Functions of angles, in degrees.  FUN puts a copy of x on the calculator's stack
; and has the result fetched from there.

; FTG - tangent, sine by cosine
; In:  HL -> x   Out: x; ERR 05 for odd multiples of 90   Clobbers all
FTG:    CALL    FUN
        RST     5
        DB      QDUP,QSIN,QSWP,QCOS,QDIV ; tan x
        DB      QRET

; FCOS - cosine
; In:  HL -> x   Out: x; ERR 05 as FSIN   Clobbers all
FCOS:   CALL    FUN
        RST     5
        DB      QABS,Q90,QSWP,QSUB      ; 90-|x|
        DB      QSIN,QRET               ; cos x

; FSIN - sine
; In:  HL -> x   Out: x; ERR 05 from 2^33 on, where the turns are too many to count
; Clobbers all
FSIN:   MOV     A,M
        CPI     0A2H
        JNC     FOVF
        CALL    FUN
        RST     5
        DB      QDUP,QI180,QMUL         ; x x/180
        DB      QHALF,QADD,QFLR         ; x k           k half turns
        DB      QSWP,QOVR,Q180,QMUL     ; k x k*180
        DB      QSUB                    ; k r           -90...90
        DB      QSWP,QHALF,QMUL         ; r k/2
        DB      QDUP,QFLR,QSUB          ; r 0 or 1/2
        DB      QJZ
        DB      FSIN1-$
        DB      QNEG                    ; r             after an odd number: the other way
FSIN1:  DB      QI64,QMUL,QEND          ; r/64
        LXI     D,CSIN
; (fall into FSER)

; FSER - y + y * a polynomial in y*y: that way the error of the polynomial hardly
;        counts
; In:  y on the calculator's stack, DE -> coefficients, highest first, and a 0
; Out: the sum instead of y   Clobbers all
FSER:   PUSH    D
        RST     5
        DB      QDUP,QSQ,Q0,QEND        ; y z 0         z = y*y
FSER1:  RST     5
        DB      QOVR,QMUL,QEND          ; y z s*z
        POP     D
        CALL    OOVR                    ; y z s*z c
        PUSH    D
        RST     5
        DB      QADD,QEND               ; y z s
        POP     D
        PUSH    D
        LDAX    D
        ORA     A
        JNZ     FSER1
        POP     D
        RST     5
        DB      QSWP,QDRP               ; y s
        DB      QOVR,QMUL,QADD          ; y+y*s
        DB      QRET

; sin(64 y) = y + y*P(y*y) for |y| <= 90/64, to 2^-35
CSIN:   DB      069H,0ADH,021H,0E3H,00AH        ; -8.06E-8
        DB      06FH,07AH,005H,06DH,015H        ;  7.451E-6
        DB      075H,0E1H,0B3H,026H,0F5H        ; -0.00043048823
        DB      07AH,06DH,06CH,0A2H,077H        ;  0.01449123254
        DB      07EH,0EDH,0DCH,010H,05FH        ; -0.2322847898
        DB      07DH,06FH,0A3H,051H,028H        ;  0.1170107212
        DB      0
; atan(y)/64 = y + y*P(y*y) for |y| <= 1/2, to 2^-32
CATG:   DB      07CH,00CH,0BAH,07DH,06BH        ;  0.03435753815
        DB      07DH,091H,0DFH,09BH,0BDH        ; -0.07122728033
        DB      07DH,048H,070H,0C7H,0D1H        ;  0.0978713618
        DB      07EH,082H,0D3H,035H,01BH        ; -0.1277588175
        DB      07EH,037H,057H,04AH,03BH        ;  0.1790439223
        DB      07FH,098H,0C9H,0E8H,075H        ; -0.2984154361
        DB      07DH,0D6H,088H,0F9H,06EH        ; -0.1047534453
        DB      0

; FATG - arc tangent
; In:  HL -> x   Out: x, between -90 and 90   Clobbers all
FATG:   CALL    FUN
        LXI     D,-4
        DAD     D
        MOV     A,M
        PUSH    PSW             ; sign
        ANI     7FH
        MOV     M,A
        DCX     H
        MOV     A,M
        CPI     80H
        JC      FATG2           ; below 1/2
        CPI     82H
        JC      FATG1           ; below 2
        RST     5
        DB      Q90,QSWP                ; 90 x
        DB      Q1,QNEG,QSWP,QDIV       ; 90 -1/x
        DB      QJMP
        DB      FATG3-$
FATG1:  RST     5
        DB      Q90,QHALF,QMUL,QSWP     ; 45 x
        DB      QDUP,Q1,QSUB            ; 45 x x-1
        DB      QSWP,Q1,QADD,QDIV       ; 45 (x-1)/(x+1)
        DB      QJMP
        DB      FATG3-$
FATG2:  RST     5
        DB      Q0,QSWP                 ; 0 x
FATG3:  DB      QEND
        LXI     D,CATG
        CALL    FSER
        RST     5
        DB      QI64,QDIV,QADD,QEND     ; atan |x|
        POP     PSW
        RLC
        RNC
        RST     5
        DB      QNEG,QRET

; Decimal numbers.  FBIG holds one with 16 bytes before and 22 behind the point,
; first byte first: every float exactly.

; FCLR - clears FBIG, DIGS and the cells behind FBIG
; Clobbers A, DE
FCLR:   LXI     D,DIGS-5
FCLR1:  XRA     A
        STAX    D
        INX     D
        MOV     A,E
        CPI     FWEND&255
        JNZ     FCLR1
        RET

; FM10W - multiplies the whole part of FBIG by 10 and adds
; FM10  - multiplies FBIG by 10 and adds
; In:  HL -> last byte (FM10 alone), BC = added   Out: C = carry   Clobbers all
; Cycles: 159 a byte
FM10W:  LXI     H,UNITS
FM10:   PUSH    H
        MOV     E,M
        MVI     D,0
        MOV     H,D
        MOV     L,E
        DAD     H
        DAD     H
        DAD     D
        DAD     H
        DAD     B
        MOV     C,H
        MOV     A,L
        POP     H
        MOV     M,A
        DCX     H
        MOV     A,L
        ORA     A
        JM      FM10            ; FBIG begins at 80H of a page
        RET

; FD10 - divides FBIG by 10
; In:  B = bytes, from the first on   Out: A = remainder, Z: it was zero
; Clobbers all   Cycles: 54 a byte that stays 0, else 490
FD10:   LXI     D,FBIG
        LXI     H,0
        MVI     C,1
FD101:  LDAX    D
        MOV     L,A
        ORA     H
        JZ      FD104
        MVI     C,8
FD102:  DAD     H               ; H = remainder, L = quotient behind the dividend
        MOV     A,H
        SUI     10
        JC      FD103
        MOV     H,A
        INR     L
FD103:  DCR     C
        JNZ     FD102
        MOV     A,L
        STAX    D
FD104:  INX     D
        DCR     B
        JNZ     FD101
        DCR     C
        MOV     A,H
        RET

; DECOUT - prints a number
; In:  HL -> x, B = most significant digits (8 or 9)   Clobbers all
DECOUT: MOV     A,M
        ORA     A
        MVI     A,CZERO
        JZ      PUTC
        PUSH    B
        CALL    FCLR
        MOV     B,M
        INX     H
        MOV     A,M
        RLC
        MVI     A,CMINUS
        CC      PUTC
        PUSH    B
        CALL    FLOAD
        POP     PSW
        PUSH    PSW
        CMA
        INR     A
        ANI     7
        CALL    FSHR            ; so that bytes of B C D E L are bytes of FBIG
        POP     PSW
        PUSH    H
        ADI     7
        RAR
        RRC
        RRC
        ANI     3FH             ; bytes from 2^-128 up
        CMA
        ADI     (FBIG+33)&255
        MOV     L,A
        MVI     H,FBIG/256
        MOV     M,B
        INX     H
        CALL    FPAC1
        INX     H
        POP     B
        MOV     M,C
; times 10 until it is whole or has ten digits before the point
DECO1:  LDA     FBIG+11
        ORA     A
        JNZ     DECO3
        LXI     H,BIGEND
DECO2:  DCX     H
        MOV     A,M
        ORA     A
        JZ      DECO2
        MOV     A,L
        CPI     (UNITS+1)&255
        JC      DECO3
        LXI     B,0
        CALL    FM10
        LXI     H,POWER
        DCR     M
        JMP     DECO1
; digits, the last first, each put in front
DECO3:  MVI     B,16
        CALL    FD10
        JZ      DECO5
        LXI     H,DIGS
        MVI     C,10
DECO4:  MOV     B,M
        MOV     M,A
        MOV     A,B
        INX     H
        DCR     C
        JNZ     DECO4
        LXI     H,POWER
        INR     M
        JMP     DECO3
; round
DECO5:  POP     B
        LXI     H,DIGS
        MOV     A,L
        ADD     B
        MOV     L,A
        MOV     A,M
        CPI     5
        CMC
DECO6:  DCX     H
        MOV     A,M
        ACI     0
        MOV     M,A
        JZ      DECO6           ; no zeros at the end
        SUI     10
        JNZ     DECO7
        MOV     M,A
        STC
        JMP     DECO6
DECO7:  LXI     D,DIGS-1        ; HL -> last digit, DE -> first
        LDA     POWER
        INR     A
        MOV     C,A             ; C = digits before the point
        LDAX    D
        ORA     A
        JNZ     DECO8
        INX     D
        DCR     C
DECO8:  MVI     B,0             ; B = exponent, 0: none
        MOV     A,C
        ADI     4
        CPI     13
        JC      DECO9
        MOV     B,C
        DCR     B
        MVI     C,1
DECO9:  MOV     A,C
        DCR     A
        JP      DECOA
        ADD     E               ; zeros in front, one before the point
        MOV     E,A
        MVI     C,1
DECOA:  LDAX    D
        ADI     CZERO
        RST     2
        MOV     A,E
        CMP     L               ; CY: there are more
        INX     D
        DCR     C
        JZ      DECOB
        JP      DECOA
        JC      DECOA
DECOB:  MVI     A,CPOINT
        JNC     DECOC
        RST     2
        JMP     DECOA
DECOC:  MOV     A,B
        ORA     A
        RZ
        MVI     A,CLTE
        RST     2
        XRA     A
        MOV     H,A
        MOV     L,B
        SUB     B
        JM      PRDEC
        MOV     L,A
        MVI     A,CMINUS
        RST     2
        JMP     PRDEC

; DECIN - reads a number; it is rounded to 9 digits first
; In:  HL -> text, a digit or a point, DE -> float
; Out: float, HL -> first character behind it; CY: it is no number; ERR 05
; Clobbers all
DECIN:  PUSH    D
        CALL    FCLR
        LXI     B,0             ; B = digits that count, C = 0FFH behind the point
        LXI     D,0FFH          ; D = power of ten, E = 0FFH: no digit yet
DECI1:  CALL    LEXCH
        CPI     CPOINT
        JNZ     DECI2
        MOV     A,C
        ORA     A
        JNZ     DECI6           ; the second
        DCR     C
        INX     H
        JMP     DECI1
DECI2:  CALL    DIGIT
        JNC     DECI6
        INX     H
        MOV     E,A
        MOV     A,D
        ADD     C
        MOV     D,A
        MOV     A,B
        ORA     E
        JZ      DECI1           ; a zero in front does not count
        INR     B
        MOV     A,B
        CPI     10
        JC      DECI5
        JNZ     DECI4
        MOV     A,E
        CPI     5
        JC      DECI4
        PUSH    H
        LXI     H,UNITS+1       ; the tenth digit rounds
DECI3:  DCX     H
        INR     M
        JZ      DECI3
        POP     H
DECI4:  INR     D
        JMP     DECI1
DECI5:  PUSH    H
        PUSH    D
        PUSH    B
        MOV     C,E
        MVI     B,0
        CALL    FM10W
        POP     B
        POP     D
        POP     H
        JMP     DECI1
DECI6:  INR     E
        JZ      DECIE           ; no digit at all
        CALL    LEXCH
        CPI     CLTE
        JNZ     DECIA
        PUSH    H               ; -> E, which may begin a word
        INX     H
        CALL    LEXCH
        SUI     CPLUS
        MOV     C,A             ; 2: minus
        JZ      DECI7
        CPI     CMINUS-CPLUS
        JNZ     DECI8
DECI7:  INX     H
DECI8:  MVI     B,0             ; B = exponent
        MVI     E,0FFH
DECI9:  CALL    LEXCH
        CALL    DIGIT
        JNC     DECIX
        INX     H
        MOV     E,A
        MOV     A,B
        CPI     10
        JNC     FOVF
        ADD     A
        ADD     A
        ADD     B
        ADD     A
        ADD     E
        MOV     B,A
        JMP     DECI9
DECIX:  INR     E
        JZ      DECIY
        XTHL
        POP     H
        MOV     A,C
        CPI     CMINUS-CPLUS
        MOV     A,D
        JZ      DECIS
        ADD     B
        DB      0FEH            ; CPI: skips the SUB
DECIS:  SUB     B
        MOV     D,A
DECIA:  PUSH    H
DECIB:  MOV     A,D
        ORA     A
        JZ      DECID
        PUSH    D
        JM      DECIC
        LXI     B,0
        CALL    FM10W
        MOV     A,C
        ORA     A
        JNZ     FOVF
        POP     D
        DCR     D
        JMP     DECIB
DECIC:  MVI     B,38
        CALL    FD10
        POP     D
        INR     D
        JMP     DECIB
DECID:  POP     H               ; text
        XTHL
        LXI     D,DECIF
        PUSH    D
        PUSH    H
        LXI     H,FBIG-1
DECIG:  INX     H
        MOV     A,L
        CPI     (FBIG+32)&255
        JZ      FZERO
        MOV     A,M
        ORA     A
        JZ      DECIG
        MOV     A,L
        ADD     A
        ADD     A
        ADD     A
        CMA
        STA     EXPO
        MOV     A,M
        CALL    FLOA1
        INX     H
        MOV     L,M
        JMP     FNRM1
DECIF:  POP     H
        ORA     A
        RET
DECIY:  POP     H               ; the E is not ours
        JMP     DECIA
DECIE:  POP     D
        STC
        RET
CPOINT  EQU 2EH         ; .
CPLUS   EQU 2BH         ; +
CLTE    EQU 45H

FLTEND  EQU     $               ; (for the table of bytes)
