; io_ok.asm - blocks go out with LF alone, each waits for the machine's ok (milling.md, section "Handshake")
; Offers: BLKON BLKOFF
; Uses:   [punch] io start
; Room:   109 bytes
;
; A line of the machine is judged when it is over, and typed from memory: the teletype is slower than the
; machine's line, and the receiver holds one character.  LINBUF is free while a statement works.

; BLKON - a block begins: what is printed from here on is punched too
; Clobbers A
BLKON   EQU     PUNON

; BLKOFF - a block ends, with CR LF on the paper; waits until the machine has said ok.  That of an error does not wait
; Out: OUTSEL = paper; ERR 10: the machine refuses it, or a break   Clobbers A, B, DE, HL
; Cycles: at most 220 until a character is taken, behind a line that means nothing 430
BLKOFF: LXI     H,OUTSEL
        INR     M
        CALL    CRLF
BLKOF1: CALL    BDREAD          ; what has come so far is no answer
        JNZ     BLKOF1
        MVI     B,CLF
        CALL    BDPUN
        CALL    CHECK
        RNZ                     ; after an error
BLKOF2: LXI     D,LINBUF        ; a line of the machine begins
BLKOF3: CALL    BREAK
BLKOF4: CALL    BDREAD
        JZ      BLKOF3
        CPI     CBLANK
        JC      BLKOF5          ; CR, LF: it is over
        ORA     A
        JM      ERTAPE          ; a character is lost
        STAX    D
        INR     E
        JNZ     BLKOF4
        DCR     E               ; full: what comes now does not count (LINBUF ends with a page)
        JMP     BLKOF4
BLKOF5: XRA     A
        STAX    D
        LXI     H,SAYOK
        CALL    SAID
        RZ
        LXI     H,SAYERR
        CALL    SAID
        LXI     H,SAYALA
        CNZ     SAID
        JNZ     BLKOF2          ; it means nothing
        LXI     H,LINBUF
        CALL    PUTS
        DB      ERROR,ETAPE

; SAID - does the machine's line begin with a text?
; In:  HL-> text, bit 7 of its last character set   Out: Z: yes   Clobbers A, DE, HL
SAID:   LXI     D,LINBUF
SAID1:  LDAX    D
        XRA     M
        ADD     A               ; CY: bit 7
        RNZ
        INX     D
        INX     H
        JNC     SAID1
        RET

SAYOK:  DB      "o",0EBH
SAYERR: DB      "erro",0F2H
SAYALA: DB      "ALAR",0CDH
