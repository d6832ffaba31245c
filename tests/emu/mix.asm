; MIX - THE BENCHMARK'S WORKLOAD
;
; A CP/M program of our own with the work of the public exercisers: an instruction is put
; together in RAM and carried out on a machine state that counters and masks run through,
; and a table-driven CRC-32 takes in every state. Besides, what firmware does all day: BCD and binary
; arithmetic of several bytes, rotates, block moves, a search, calls and conditional returns.
; Ends with the CRC printed as 8 hexadecimal digits.

BDOS:   EQU     5
ROUNDS: EQU     2400            ; of the outer loop

        ORG     100H
        LXI     SP,STACK
        CALL    MAKTAB
        LXI     H,ROUNDS
        SHLD    ROUND
LOOP:   CALL    STATES          ; 24 instructions on 2 states each
        CALL    BCD
        CALL    MULT
        CALL    BLOCK
        CALL    SHIFT
        LHLD    ROUND
        DCX     H
        SHLD    ROUND
        MOV     A,H
        ORA     L
        JNZ     LOOP
        LXI     H,CRC+3
        MVI     C,4
SHOW:   MOV     A,M
        RRC
        RRC
        RRC
        RRC
        CALL    DIGIT
        MOV     A,M
        CALL    DIGIT
        DCX     H
        DCR     C
        JNZ     SHOW
        JMP     0

; DIGIT - PRINT THE LOW HALF OF A.  USES A F DE
DIGIT:  ANI     0FH
        ADI     90H             ; A and beyond make a carry in DAA
        DAA
        ACI     40H
        DAA
        MOV     E,A
        PUSH    B
        PUSH    H
        MVI     C,2
        CALL    BDOS
        POP     H
        POP     B
        RET

; MAKTAB - THE CRC'S TABLE: 256 WORDS OF 4 BYTES FOR THE POLYNOMIAL EDB88320
MAKTAB: LXI     H,TABLE
        MVI     C,0             ; C = index
MAKT1:  PUSH    H
        MOV     L,C
        MVI     H,0
        LXI     D,0             ; DEHL = index
        MVI     B,8
MAKT2:  XRA     A               ; shift DEHL right
        MOV     A,D
        RAR
        MOV     D,A
        MOV     A,E
        RAR
        MOV     E,A
        MOV     A,H
        RAR
        MOV     H,A
        MOV     A,L
        RAR
        MOV     L,A
        JNC     MAKT3
        MOV     A,D
        XRI     0EDH
        MOV     D,A
        MOV     A,E
        XRI     0B8H
        MOV     E,A
        MOV     A,H
        XRI     83H
        MOV     H,A
        MOV     A,L
        XRI     20H
        MOV     L,A
MAKT3:  DCR     B
        JNZ     MAKT2
        XTHL                    ; HL-> table
        MOV     B,H
        MOV     A,L
        POP     H
        PUSH    D
        MOV     D,B
        MOV     E,A
        MOV     A,L
        STAX    D
        INX     D
        MOV     A,H
        STAX    D
        INX     D
        POP     H
        MOV     A,L
        STAX    D
        INX     D
        MOV     A,H
        STAX    D
        INX     D
        XCHG
        INR     C
        JNZ     MAKT1
        RET

; STATES - CARRY OUT THE INSTRUCTIONS OF THE LIST, EACH ON 2 STATES
STATES: LXI     H,LIST
STAT1:  MOV     A,M
        ORA     A
        RZ                      ; end of the list
        STA     WORK
        INX     H
        MOV     A,M
        STA     WORK+1
        INX     H
        MOV     A,M
        STA     WORK+2
        INX     H
        PUSH    H
        CALL    COUNT
        CALL    TEST
        CALL    MASK
        CALL    TEST
        POP     H
        JMP     STAT1

; TEST - THE INSTRUCTION AT WORK, FROM STATE IN TO STATE OUT, AND THE CRC OF THE RESULT
TEST:   LXI     H,0
        DAD     SP
        SHLD    OLDSP
        LXI     SP,IN
        POP     PSW
        POP     B
        POP     D
        POP     H
        LXI     SP,STACK-40H
WORK:   NOP
        NOP
        NOP
        LXI     SP,OUTEND
        PUSH    H
        PUSH    D
        PUSH    B
        PUSH    PSW
        LHLD    OLDSP
        SPHL
        LXI     H,OUT
        MOV     A,M             ; S Z AC P CY alone
        ANI     0D5H
        MOV     M,A
        MVI     B,12            ; the state and the memory that it works on
TEST1:  MOV     A,M
        CALL    UPDATE
        INX     H
        DCR     B
        JNZ     TEST1
        RET

; UPDATE - TAKE A INTO THE CRC.  IN A=byte  USES F
UPDATE: PUSH    B
        PUSH    D
        PUSH    H
        LXI     H,CRC
        XRA     M               ; A = index
        MOV     E,A
        MVI     D,0
        XCHG
        DAD     H
        DAD     H
        LXI     B,TABLE
        DAD     B
        XCHG                    ; DE-> table word, HL-> CRC
        MVI     B,3
UPD1:   INX     H               ; CRC = CRC >> 8 ^ word
        LDAX    D
        XRA     M
        DCX     H
        MOV     M,A
        INX     D
        INX     H
        DCR     B
        JNZ     UPD1
        LDAX    D
        MOV     M,A
        POP     H
        POP     D
        POP     B
        RET

; COUNT - THE STATE IN AS A COUNTER
COUNT:  LXI     H,IN
COUN1:  MVI     A,7
        ADD     M
        MOV     M,A
        RNC
        INX     H
        MOV     A,L
        CPI     INEND
        RZ
        JMP     COUN1

; MASK - TURN OVER THE BITS OF THE STATE IN THAT THE MASK HAS
MASK:   LXI     H,IN
        LXI     D,MASKS
        MVI     B,8
MASK1:  LDAX    D
        RLC
        STAX    D
        XRA     M
        MOV     M,A
        INX     H
        INX     D
        DCR     B
        JNZ     MASK1
        RET

; BCD - ADD ONE DECIMAL NUMBER OF 16 DIGITS TO ANOTHER
BCD:    LXI     H,DEC1
        LXI     D,DEC2
        MVI     B,8
        ORA     A
BCD1:   LDAX    D
        ADC     M
        DAA
        MOV     M,A
        INX     H
        INX     D
        DCR     B
        JNZ     BCD1
        RET

; MULT - 16 X 16 BITS BY SHIFT AND ADD
MULT:   LHLD    DEC1
        XCHG                    ; DE = multiplicand
        LHLD    IN+2
        MOV     B,H
        MOV     C,L             ; BC = multiplier
        LXI     H,0
        MVI     A,16
MULT1:  DAD     H
        PUSH    PSW
        MOV     A,C
        RAL
        MOV     C,A
        MOV     A,B
        RAL
        MOV     B,A
        JNC     MULT2
        DAD     D
MULT2:  POP     PSW
        DCR     A
        JNZ     MULT1
        SHLD    OUT+8
        RET

; BLOCK - MOVE 64 BYTES AND LOOK FOR ONE
BLOCK:  LXI     H,TABLE
        LXI     D,ROOM
        MVI     B,64
BLOC1:  MOV     A,M
        STAX    D
        INX     H
        INX     D
        DCR     B
        JNZ     BLOC1
        LXI     H,ROOM
        LDA     IN
        MVI     C,64
BLOC2:  CMP     M
        RZ
        INX     H
        DCR     C
        JNZ     BLOC2
        RET

; SHIFT - TURN 8 BYTES RIGHT BY ONE BIT, 4 TIMES
SHIFT:  MVI     C,4
SHIF1:  LXI     H,ROOM+8
        MVI     B,8
        ORA     A
SHIF2:  DCX     H
        MOV     A,M
        RAR
        MOV     M,A
        DCR     B
        JNZ     SHIF2
        DCR     C
        JNZ     SHIF1
        RET

; The instructions, 3 bytes each; 0 ends the list.
LIST:   ADD     B
        NOP
        NOP
        ADC     C
        NOP
        NOP
        SUB     D
        NOP
        NOP
        SBB     E
        NOP
        NOP
        ANA     H
        NOP
        NOP
        XRA     L
        NOP
        NOP
        ORA     A
        NOP
        NOP
        CMP     B
        NOP
        NOP
        ADI     5AH
        NOP
        SBI     0C3H
        NOP
        DAA
        NOP
        NOP
        CMA
        NOP
        NOP
        RAL
        NOP
        NOP
        RRC
        NOP
        NOP
        INR     H
        NOP
        NOP
        DCR     C
        NOP
        NOP
        DAD     D
        NOP
        NOP
        DAD     B
        NOP
        NOP
        INX     H
        NOP
        NOP
        DCX     D
        NOP
        NOP
        MOV     D,L
        NOP
        NOP
        LDA     OUT+9
        LHLD    DEC1
        SHLD    OUT+8
        DB      0

MASKS:  DB      1,2,4,8,16,32,64,128
DEC1:   DB      12H,34H,56H,78H,90H,12H,34H,56H
DEC2:   DB      11H,72H,35H,81H,64H,99H,27H,3
CRC:    DB      0,0,0,0
IN:     DB      0,0,0,0,0,0,0,0 ; F A C B E D L H
INEND:
OUT:    DB      0,0,0,0,0,0,0,0
OUTEND: DB      0,0,0,0
OLDSP:  DW      0
ROUND:  DW      0
ROOM:   DS      64
        ORG     2000H
TABLE:  DS      400H
        DS      100H
STACK:
