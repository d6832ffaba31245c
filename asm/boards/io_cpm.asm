; io_cpm.asm - the teletype's characters, through the BIOS of CP/M
; Offers: BSELDK OFILE PAPER POLL UNKEY
; Uses:   [punch] start
; Room:   200 bytes
;
; The BIOS, not the BDOS, which would act on ctrl-S, ctrl-P and ctrl-C itself.  Keys that come while
; a statement works wait in KEYQ; at the prompt no key is taken before it is needed, so that what is
; typed behind BYE is CP/M's.  ctrl-C empties the queue.

BCONST  EQU     3               ; entries of the BIOS, from that of the warm boot: is there a key? 0: no
BCONIN  EQU     6               ; next key
BCONOU  EQU     9               ; prints C
BSELDK  EQU     24              ; HL = table of drive C, 0 when there is none
KQSIZE  EQU     32              ; places of KEYQ; two stay free: full is not empty, and UNKEY needs one
OFILE   EQU     3               ; OUTSEL: to the file alone

;! KQSIZE & (KQSIZE-1) == 0 -- places go round by ANI

; BIOS - calls an entry of the BIOS
; In:  A = its distance from that of the warm boot, C   Out: A   Clobbers nothing else
BIOS:   PUSH    H
        PUSH    D
        PUSH    B
        LXI     H,BIOS1
        PUSH    H
        LHLD    WBVEC
        CALL    ADDA
        PCHL
BIOS1:  POP     B
        POP     D
        POP     H
        RET

; PAPER - prints a character, which the tape's file gets too when the punch is on
; In:  B = it, C = OUTSEL   Clobbers A, BC, HL
PAPER:  MOV     A,C
        ORA     A
        RZ
        CPI     OFILE
        JZ      BDPUN
        LDA     CHKF
        DCR     A
        CNZ     POLL            ; (a line is typed: keys wait)
        PUSH    B
        MOV     C,B
        MVI     A,BCONOU
        CALL    BIOS
        POP     B
        DCR     C
        JZ      BDPUN
        RET

; POLL - looks at the keyboard; while ctrl-S holds, does not come back
; Out: A = KEYB, HL-> it   Clobbers nothing else
POLL:   PUSH    B
        LDA     KEYB
        CPI     CCTLC
        JZ      POLL6           ; a break waits
        LDA     LOADF
        CMA
        MOV     B,A
        LDA     CHKF
        ANA     B
        DCR     A
        LHLD    KQPUT           ; L = KQPUT, H = KQGET
        MOV     A,L
        JNZ     POLL1
        CMP     H               ; at the prompt a key is taken when there is none
        JNZ     POLL4
POLL1:  ADI     2
        ANI     KQSIZE-1
        CMP     H
        JZ      POLL4           ; full
        MVI     A,BCONST
        CALL    BIOS
        ORA     A
        JZ      POLL4
POLL2:  MVI     A,BCONIN
        CALL    BIOS
        ANI     7FH
        CPI     CXOFF
        JZ      POLL2
        CPI     CCTLC
        JZ      POLL3
        MVI     H,KEYQ/256      ; HL-> its place
        MOV     M,A
        MOV     A,L
        INR     A
        ANI     KQSIZE-1
        STA     KQPUT
        JMP     POLL4
POLL3:  STA     KEYB
        LXI     H,0
        SHLD    KQPUT
POLL4:  LDA     KEYB            ; the oldest key comes when the one before it is used
        ORA     A
        JNZ     POLL6
        LHLD    KQPUT
        MOV     A,H
        CMP     L
        JZ      POLL6
        MOV     L,A
        MVI     H,KEYQ/256
        INR     A
        ANI     KQSIZE-1
        STA     KQGET
        MOV     A,M
        STA     KEYB
POLL6:  LXI     H,KEYB
        MOV     A,M
        POP     B
        RET

; UNKEY - a key that has come while a line is read from a file waits on
; Clobbers A, B, HL
UNKEY:  LXI     H,KEYB
        MOV     B,M
        MVI     M,0
        DCR     B
        INR     B
        RZ                      ; there is none
        LDA     KQGET
        DCR     A
        ANI     KQSIZE-1
        STA     KQGET
        MOV     L,A
        MVI     H,KEYQ/256
        MOV     M,B
        RET
