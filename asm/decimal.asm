; decimal.asm - numbers as decimal digits: read, printed
; Offers: DECOUT PRDEC DECIN LEXDEC TEN DIGIT LEXCH
; Uses:   calc consts float start
; Room:   457 bytes
;
; Decimal numbers.  They are scaled by one multiplication or division by a power of ten,
; which is exact up to 10^13.  So DECIN gives the nearest float to up to 9 digits, and
; 9 digits from DECOUT give that float again, from 1E-4 to 1E13, and up to 1E22 unless
; they end in zeros; beyond, powers are taken in steps of 10^16, and the error is at most
; 10 units of 2^-32.

TENLOG  EQU 0DA87H      ; of exponent 0: high byte = digits before the point, rounded up
DECMAX  EQU 3FFH        ; a number as good as any greater one: no subscript, past every exponent

; FTEN - |t0| / 10^C
; In:  C = -128...127   Out: on the calculator's stack; ERR 05   Clobbers all
FTEN:   MOV     A,C             ; C = sign
        RAL
        SBB     A
        MOV     B,A
        XRA     C
        SUB     B
        MOV     B,A             ; B = power to go
        PUSH    B
        DB      CALC,LT0,QABS
FTEN2:  DB      QEND            ; x
        POP     B
        MOV     A,B
        ORA     A
        RZ
        PUSH    B
        DB      CALC,Q1,QEND    ; x p
FTEN3:  DB      CALC,Q10,QMUL,QEND ; x p
        POP     B
        DCR     B
        PUSH    B
        MOV     A,B
        ANI     0FH
        JNZ     FTEN3           ; larger powers in steps of 10^16
        ORA     C
        JM      FTEN4
        DB      CALC,QDIV,QJMP  ; x/p
        DB      FTEN2-$
FTEN4:  DB      CALC,QMUL,QJMP  ; x*p
        DB      FTEN2-$

; FDIG - divides a whole number by 10
; In:  D E H L   Out: D E H L, A = remainder, Z: it is 0, CY clear, B = 0, C = C+1   Clobbers nothing else
; Cycles: 2,500; below 65536 1,300, below 256 700
FDIG:   MVI     B,32
        MOV     A,D
        ORA     E
        JNZ     FDIG0
        MVI     B,16            ; the high half is 0: start behind it
        XCHG
        ORA     D
        JNZ     FDIG0
        MOV     D,E             ; so is the next byte
        MOV     E,A
        MVI     B,8
FDIG0:  XRA     A
FDIG1:  XCHG
        DAD     H
        RAL                     ; A = remainder, quotient comes in behind the number
        XCHG
        DAD     H
        JNC     FDIG2
        INX     D
FDIG2:  CPI     10
        JC      FDIG3
        SUI     10
        INR     L
FDIG3:  DCR     B
        JNZ     FDIG1
        INR     C
        ORA     A
        RET

; DECOUT - prints a number times a power of ten; other powers than 0 go with a whole x below 2^27 and B = 9
; In:  HL -> x, B = most significant digits (8 or 9), E = power of ten   Clobbers all, and t0
; Cycles: whole numbers below 2^26 2,600 a digit, others 60,000 to 150,000
DECOUT: CALL    FSGN
        MVI     A,CZERO
        JZ      PUTC0
        MVI     A,CMINUS
        CM      PUTC0
        MOV     C,E
        PUSH    B
        XCHG
        LXI     H,MT0
        PUSH    H
        CALL    COPY5
        POP     H
        MOV     A,B
        ADI     92H
        CMP     M
        JC      DECO1
        CALL    FWHOLE
        MOV     A,L
        ORA     A
        JZ      DECO4           ; whole, of at most B digits (below 2^26 or 2^27)
; C = the power of ten of the first digit, from the exponent of two: right or one too large
DECO1:  POP     B
        LDA     MT0
        LXI     H,TENLOG
        LXI     D,77            ; 256 * log 2
DECO2:  DAD     D
        DCR     A
        JNZ     DECO2
        MOV     C,H
        PUSH    B
        DB      CALC
DECO3:  DB      QEND
        POP     B
        DCR     C
        PUSH    B
        CALL    FTEN
        DB      CALC,Q1,QSUB,QJN ; -
        DB      DECO3-$         ; below 1: that power is too large
        DB      QEND
        POP     B
        MOV     A,C
        INR     A
        SUB     B
        MOV     C,A             ; the power that leaves B digits before the point
        PUSH    B
        CALL    FTEN            ; s
        DB      CALC,QHALF,QADD,QDRP,QEND
        CALL    FWHOLE          ; (QDRP leaves HL -> what it drops)
; D E H L = the whole number, C = the power of ten that it is to be multiplied by
DECO4:  XCHG
        MOV     D,B
        MOV     E,C
        POP     B
; DECOU1 - prints a whole number times a power of ten
; In:  D E H L = number, not 0, C = power of ten   Clobbers all
DECOU1: XRA     A
        STC                     ; CY: behind the last digit
        PUSH    PSW
DECO5:  CALL    FDIG            ; C = digits before the point so far
        JZ      DECO5
DECO6:  PUSH    PSW
        MOV     A,D
        ORA     E
        ORA     H
        ORA     L
        JNZ     DECO7
        MOV     A,C
        ADI     4
        CPI     13
        JNC     DECO8
        SUI     5
        JP      DECO9
DECO7:  CALL    FDIG            ; also zeros in front, up to the one before the point
        JMP     DECO6
DECO8:  MOV     B,C             ; B = exponent, 0: none
        DCR     B
        MVI     C,1
DECO9:  INR     C
DECOA:  POP     PSW
        DCR     C
        JNC     DECOB
        DCR     C
        JM      DECOD           ; the end, behind the point or just before it
        INR     C
        PUSH    PSW             ; zeros up to the point
DECOB:  JNZ     DECOC
        PUSH    PSW
        MVI     A,CPOINT-CZERO
DECOC:  ADI     CZERO
        DB      PUTC
        JMP     DECOA
DECOD:  MOV     A,B
        ORA     A
        RZ
        MVI     A,CLTE
        DB      PUTC
        XRA     A
        MOV     H,A
        MOV     L,B
        SUB     B
        JM      PRDEC
        MOV     L,A
        MVI     A,CMINUS
        DB      PUTC
; (fall into PRDEC)

; PRDEC - prints a whole number
; In:  HL = number, not 0   Clobbers all
PRDEC:  LXI     D,0
        MOV     C,D
        JMP     DECOU1

; DECIN - reads a number and makes a token of it, TFLT and the float (LEX comes here); digits count up to
;         2^31, those behind only for the power
; In:  HL -> text, a digit or a point, DE -> token
; Out: token, DE -> its last byte, HL -> first character behind the text; ERR 05, ERR 01 for a lone point: then
;      what stands at DE is as it was
; Clobbers all, and t0 t1
DECIN:  PUSH    D
        XRA     A
        STA     MT0
        LXI     B,0FFH          ; B = power of ten to divide by, C = 0 behind the point
        MOV     E,C             ; E = 0FFH: no digit yet
DECI1:  CALL    LEXDIG
        JC      DECI2
        XRA     C               ; (C = 0 lets no point come out as 1)
        DCR     A
        JNZ     DECI4           ; no point, or the second
        INR     C
        INX     H
        JMP     DECI1
DECI2:  INX     H
        PUSH    H
        MOV     L,A
        MVI     H,0
        MOV     A,B
        ADD     C
        MOV     B,A
        LDA     MT0
        CPI     0A0H            ; is there room for a digit?
        JNC     DECI3
        INR     B
        PUSH    B
        LXI     D,MT0+5
        CALL    FITOF
        DB      CALC,LT0,Q10,QMUL,LT1,QADD,ST0,QEND
        POP     B
DECI3:  POP     H
        MOV     E,H             ; (not 0FFH)
        JMP     DECI1
DECI4:  INR     E
        JZ      ERSYN           ; no digit at all
        CALL    LEXCH
        CPI     CLTE
        JNZ     DECI8
        PUSH    H               ; -> E, which may begin a word
        INX     H
        MVI     C,7FH           ; C = 80H for a negative exponent
        CALL    LEXCH
        CPI     CPLUS
        JZ      DECI5
        CPI     CMINUS
        JNZ     DECI6
        INR     C
DECI5:  INX     H
DECI6:  CALL    LEXDEC          ; DE = exponent
        MOV     A,D
        ORA     A
        JM      DECI7           ; no digit: the E is not ours
        JZ      DECI9
        MVI     E,0FFH          ; 256 and more are as good as that
DECI9:  MOV     A,C             ; B + 128 less the exponent, or plus a negative one: held at 0 and 255
        XRA     B
        ADD     E
        MOV     D,A
        SBB     A
        ORA     D
        XRA     C
        MOV     B,A
        XTHL                    ; -> behind it, not -> E
DECI7:  POP     H
DECI8:  XTHL
        PUSH    H
        MOV     C,B
        CALL    FTEN
        POP     D
        MVI     A,TFLT
        STAX    D
        INX     D
        CALL    CALPOP
        XCHG
        POP     H
        RET

; LEXDEC - digits of a subscript or of an exponent of ten
; In:  HL-> text   Out: DE = number, at most DECMAX, or 8000H when there is no digit; HL-> behind it
; Clobbers A
LEXDEC: LXI     D,8000H         ; (ten times that is 0)
LEXD1:  CALL    LEXDIG
        RNC
        INX     H
        PUSH    H
        CALL    TEN
        XCHG
        POP     H
        MOV     A,D
        CPI     DECMAX/256+1
        JC      LEXD1
        LXI     D,DECMAX
        JMP     LEXD1

; TEN - ten times a number, and a digit
; In:  DE, A   Out: HL   Clobbers A
TEN:    MOV     H,D
        MOV     L,E
        DAD     H
        DAD     H
        DAD     D
        DAD     H
        JMP     ADDA

; LEXDIG - is the next character that counts a digit?
; In:  HL-> text   Out: as DIGIT; HL-> it   Clobbers nothing else
LEXDIG: CALL    LEXCH
; (fall into DIGIT)

; DIGIT - is the character a digit?
; In:  A   Out: CY set: yes, A = its value   Clobbers A
DIGIT:  SUI     CZERO
        CPI     10
        RET

; LEXCH - next character that counts
; In:  HL-> text   Out: A = it, in upper case; HL-> it   Clobbers nothing else
LEXC1:  INX     H
LEXCH:  MOV     A,M
        CPI     CBLANK
        JZ      LEXC1
        CPI     CLOWA
        RC
        ANI     5FH             ; (what comes behind z turns into [ \ ] ^)
        RET
