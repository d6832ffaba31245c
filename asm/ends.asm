; ends.asm - how a route begins and ends: closed, open, dropped; FROM and BACK
; Offers: RUNINI RTNEW WIPE ENDRT SFROM ROUTER SBACK GOBACK
; Uses:   [post] calc consts corner cut fit geom parser round route start
; Room:   224 bytes

; RUNINI - the state in which a run starts: wire at O, scale 1, no route
; Clobbers all
RUNINI: DB      CALC,Q1,SSC,QEND ; -
        LXI     H,RUNCEL        ; (tape.asm)
        MVI     B,RUNLEN
        CALL    WIPE
; (fall into RTNEW)

; RTNEW - forgets the open route and the route buffer
; Clobbers all
RTNEW:  CALL    CORDON
        CALL    RTDONE
        JMP     RBNEW

; CLOSE - closes the route onto its first element, up to where it was entered
; Clobbers all
; A first point is the closing corner, written once more.
CLOSE:  LDA     RFSTP
        ORA     A
        JZ      CLOSE1
        DB      CALC,LQX,LQY,QSA ; -
        DB      LQO,SNR,QEND    ; -
        CALL    ITPNT
        CALL    PNTDON          ; (also when the last point lay within 1 um of it)
        CALL    NOFIL           ; a fillet there
CLOSE1: LDA     RELEMS
        DCR     A
        JZ      CLOSE4
        CALL    SAMEF
        JZ      CLOSE3          ; the last element is the first again
        LXI     D,MFIRST
        CALL    TON
        CALL    ADDEL
CLOSE3: DB      CALC,LCR,LFR,QE6D ; -
        DB      LGX,LGY,QTOK,QEND ; -           b = G
        LXI     D,RCORN
        LXI     H,MKX
        CALL    CPYPL           ; K = end of the first element
        CALL    PASSED          ; the corner lies before the entry, not past it
        JMP     CLOSE7
CLOSE4: LDA     CKIND           ; one element alone
        CPI     KCIR
        JNZ     ERGEO           ; a line
        LDA     RLASTP
        ORA     A
        JZ      CLOSE6
        CALL    PATC            ; by way of the last point
        CALL    PASSP
CLOSE6: LXI     H,RELEMS
        DCR     M               ; at the entry still: ADVANC takes the whole circle
CLOSE7: CALL    NOFIL           ; there is no corner
        DB      CALC,LGX,SPX,LGY,SPY ; -        the entry is the same, drawn and offset:
        DB      QPTOK,QEND      ; -             K = P = G, where the route was entered
CLOSE8: CALL    ADVANC
; (fall into RTDONE)

; RTDONE - the route is over; the buffer keeps it for RECUT
; Clobbers B, HL
RTDONE: LXI     H,HELDN
        MVI     B,FITSM+1-HELDN
; (fall into WIPE)

; WIPE - puts 0 into B bytes
; In:  HL -> the first   Out: HL behind the last, B = 0   Clobbers nothing else
WIPE:   MVI     M,0
        INX     H
        DCR     B
        JNZ     WIPE
        RET

; ENDRT - ends the open route: closed when its last item is its first, else open
; Clobbers all
ENDRT:  CALL    FITEND
        LDA     RITEMS
        ORA     A
        RZ
        DCR     A
        JZ      ERGEO           ; a single item
        CALL    NOFIL
        CALL    SAMEL
        JZ      CLOSE
        LDA     RLASTP
        ORA     A
        JZ      ERGEO           ; the end is no point
        CALL    PATC
        JMP     CLOSE8

; SFROM - statement: FROM point
SFROM:  CALL    EVPNT
        DB      CHKEND
        CALL    SCALED
        DB      CALC,QVEC       ; x y           kept while the route ends
        DB      LA0,QRND,LA1,QRND,QEND ; x y x' y'  ERR 10, before anything is done
        CALL    ENDRT
        JMP     REPOS

; ROUTER - after an error: D when a route was open, which is forgotten   Clobbers all
ROUTER: LDA     RITEMS
        PUSH    PSW
        CALL    RTNEW
        POP     PSW
        ORA     A
        RZ
        JMP     STOP

; SBACK - statement: BACK
SBACK:  DB      CHKEND
        CALL    FITEND
        CALL    NEEDEL          ; no route, or but a point
; GOBACK - the route is closed and may come again; the wire goes back to the start hole (RECUT ends here)
; Clobbers all
GOBACK: CALL    CLOSE
        LXI     H,CLOSED
        INR     M
        JMP     HOME
