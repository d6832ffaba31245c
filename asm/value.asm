; value.asm - the current value, and records that hold values
; Offers: PUTN PUTVAL PUTA XCA XNA GETREC GETA COPY15 COPY SETNUM SETK CHKRET SUBCHK ERRNG
; Uses:   start
; Room:   83 bytes
;
; The current value stands in a0 a1 a2 (unused ones zero), its kind in VKIND.

SUBMAX  EQU 999         ; greatest subscript

;! MCUR/100H == MREG/100H and MNEXT/100H == MREG/100H -- XCA and XNA

; PUTN - makes the value the next element (for items and corner)
; In:  a0 a1 a2, A = kind   Clobbers A, DE, HL
PUTN:   LXI     H,MNEXT
; (fall into PUTVAL)

; PUTVAL - puts the value into a record: kind, three numbers (for repeat)
; In:  a0 a1 a2, A = kind, HL -> where to   Out: HL behind   Clobbers A, DE
PUTVAL: MOV     M,A
        INX     H
; (fall into PUTA)

; PUTA - copies the value in a0 a1 a2
; In:  HL -> to   Out: DE, HL behind   Clobbers A
PUTA:   LXI     D,MA
        JMP     COPY15

; XCA, XNA - QCA: a = C.  QNA: a = N.  VKIND with it.  (Operations of the route, which end as GETA)
; GETREC - the same for a record: kind, three numbers (for SAME and FETCH, which has a turn in bit 7)
; In:  GETREC: DE -> record   Clobbers all
XCA:    MVI     E,MCUR & 255
        DB      SKIP2           ; skips the MVI
XNA:    MVI     E,MNEXT & 255
        MVI     D,MREG/256      ; (both lie in the registers' first page)
GETREC: LDAX    D
        ANI     7FH
        STA     VKIND
        INX     D
; (fall into GETA)

; GETA - copies a value to a0 a1 a2
; In:  DE -> from   Out: DE, HL behind   Clobbers A
GETA:   LXI     H,MA
; (fall into COPY15)

; COPY15 - copies a value (three floats)
; In:  DE -> from, HL -> to   Out: DE, HL behind   Clobbers A
COPY15: MVI     A,15
; (fall into COPY)

; COPY - copies A bytes
; In:  DE -> from, HL -> to, A = count   Out: DE, HL behind   Clobbers A
COPY:   PUSH    B
        MOV     B,A
COPY1:  LDAX    D
        MOV     M,A
        INX     D
        INX     H
        DCR     B
        JNZ     COPY1
        POP     B
        RET

; SETNUM - makes the value a number: a1 and a2 zero
; Out: VKIND   Clobbers A, B, HL
SETNUM: XRA     A
; (fall into SETK)

; SETK - makes the value one of kind A: the floats that it has not are zero
; In:  A = kind   Out: VKIND   Clobbers A, B, HL
SETK:   STA     VKIND
        SUI     KCIR
        RNC                     ; three floats
        MOV     B,A
        ADD     A
        ADD     A
        ADD     B               ; A = -5 for each float that is missing
        LXI     H,MA+14
SETK1:  MVI     M,0
        DCX     H
        INR     A
        JNZ     SETK1
        RET

; CHKRET - in check mode leaves the routine that called it; the kind of the value is not known then
; In:  CHKF   Out: in check mode HL = 4, a number that does anywhere, and VKIND = KTURN   Clobbers A
CHKRET: CALL    CHECK
        RZ
        POP     H
        LXI     H,KTURN         ; (a kind that no name and no constant has)
        SHLD    VKIND           ; (the cell behind it is free)
        RET

; SUBCHK - demands that a subscript is not too large
; In:  DE   Out: ERR 05   Clobbers HL
SUBCHK: LXI     H,-SUBMAX-1
        DAD     D
        RNC
ERRNG:  DB      ERROR,ERANGE
