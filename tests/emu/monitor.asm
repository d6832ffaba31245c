; MONITOR - A SMALL FIRMWARE FOR THE EMULATOR'S TESTS
;
; The test puts these names before it: TST TDT (teletype's status and data port), AST ADT (punch
; and reader), RXB TXB (bits of the status), TTYP (1: the teletype has punch and reader).
;
; At the prompt: L takes the tape to RAM, until ctrl-Z or silence; R carries it out; anything else is ERR 01.
; A line on the tape: P punches the rest, T prints it, I asks and punches the answer, E is an error,
; H halts, W waits for a key, J loops until ctrl-C, B writes into the ROM and past the RAM.

PROG:   EQU     2100H
LINE:   EQU     2000H

        ORG     0
        LXI     SP,2800H
        CALL    INIT
        LXI     H,PROG
        MVI     M,1AH
PROMPT: LXI     SP,2800H
        MVI     A,'>'
        CALL    PUTC
        CALL    GETL
        LDA     LINE
        CPI     'L'
        JZ      LOAD
        CPI     'R'
        JZ      RUN
        MVI     C,'1'
ERROR:  LXI     H,ERRMSG
        CALL    PUTS
        MOV     A,C
        CALL    PUTC
        CALL    CRLF
        JMP     PROMPT

INIT:   LXI     H,SETUP
INIT1:  MOV     A,M
        CPI     0FFH
        RZ
        OUT     TST
        OUT     AST
        INX     H
        JMP     INIT1

; LOAD - THE TAPE TO RAM
LOAD:   LXI     H,PROG
LOAD1:  LXI     D,20000         ; silence of about a second ends it
LOAD2:  CALL    TAPE
        JNZ     LOAD3
        DCX     D
        MOV     A,D
        ORA     E
        JNZ     LOAD2
        MVI     A,1AH
LOAD3:  MOV     M,A
        INX     H
        CPI     1AH
        JNZ     LOAD1
        JMP     PROMPT

; TAPE - OUT Z=nothing there, else A=character
TAPE:   MVI     A,TTYP
        ORA     A
        JNZ     TAPE1
        IN      AST
        ANI     RXB
        RZ
        IN      ADT
        ORA     A
        RET
TAPE1:  IN      TST
        ANI     RXB
        RZ
        IN      TDT
        ANI     7FH
        RET

; RUN - CARRY OUT THE LINES
RUN:    LXI     H,PROG
RUN1:   MOV     A,M
        INX     H
        CPI     1AH
        JZ      PROMPT
        CPI     'P'
        JZ      PUNCHL
        CPI     'T'
        JZ      PRINTL
        CPI     'I'
        JZ      ASK
        MVI     C,'5'
        CPI     'E'
        JZ      ERROR
        CPI     'H'
        JZ      STOP
        CPI     'W'
        CZ      GETC
        CPI     'J'
        JZ      LOOP
        CPI     'B'
        JZ      BUS
        JMP     RUN1
STOP:   HLT
LOOP:   IN      TST
        ANI     RXB
        MVI     B,100           ; more than the operator takes for a question
LOOP1:  DCR     B
        JNZ     LOOP1
        JZ      LOOP2
LOOP2:  IN      TST
        ANI     RXB
        JZ      LOOP
        IN      TDT
        CPI     3
        JNZ     LOOP
        CALL    CRLF
        JMP     PROMPT
BUS:    XRA     A
        STA     1FFFH           ; ROM
        STA     0FFFFH          ; nothing there
        LDA     1FFFH
        CALL    HEX
        LDA     0FFFFH
        CALL    HEX
        CALL    CRLF
        JMP     RUN1
PUNCHL: MVI     B,0
        CALL    TOPUN
        JMP     RUN1
PRINTL: MOV     A,M
        INX     H
        CALL    PUTC
        CPI     10
        JNZ     PRINTL
        JMP     RUN1
ASK:    PUSH    H
        MVI     A,'?'
        CALL    PUTC
        MVI     A,' '
        CALL    PUTC
        CALL    GETL
        LXI     H,LINE
        CALL    TOPUN
        POP     H
        JMP     RUN1

; TOPUN - PUNCH THE LINE AT HL TO ITS LF
TOPUN:  MVI     A,TTYP
        ORA     A
        JZ      TOPU1
        MVI     A,12H
        CALL    PUTC
        CALL    PRINTH
        MVI     A,14H
        JMP     PUTC
PRINTH: MOV     A,M
        INX     H
        CALL    PUTC
        CPI     10
        JNZ     PRINTH
        RET
TOPU1:  IN      AST
        ANI     TXB
        JZ      TOPU1
        MOV     A,M
        INX     H
        OUT     ADT
        CPI     10
        JNZ     TOPU1
        RET

; GETL - A LINE WITH ITS CR LF TO LINE, ECHOED
GETL:   LXI     H,LINE
GETL1:  CALL    GETC
        CALL    PUTC
        MOV     M,A
        INX     H
        CPI     13
        JNZ     GETL1
        MVI     A,10
        MOV     M,A
        JMP     PUTC
GETC:   IN      TST
        ANI     RXB
        JZ      GETC
        IN      TDT
        ANI     7FH
        RET
HEX:    PUSH    PSW
        RRC
        RRC
        RRC
        RRC
        CALL    HEX1
        POP     PSW
HEX1:   ANI     0FH
        ADI     90H
        DAA
        ACI     40H
        DAA
PUTC:   PUSH    PSW
PUTC1:  IN      TST
        ANI     TXB
        JZ      PUTC1
        POP     PSW
        OUT     TDT
        RET
PUTS:   MOV     A,M
        ORA     A
        RZ
        CALL    PUTC
        INX     H
        JMP     PUTS
CRLF:   MVI     A,13
        CALL    PUTC
        MVI     A,10
        JMP     PUTC
ERRMSG: DB      "ERR 0",0
