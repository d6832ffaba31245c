; consts.asm - constants of the calculator
; Offers: Q1 Q0 QM1 QI64 QHALF QMU Q90 Q1000 QNEAR Q502 QEPS Q10 QI180 CONTAB
; Uses:   nothing
; Room:   75 bytes
;
; A byte-code line Qx EQU 0C0H+n goes with the n-th float of CONTAB (format: see
; float.asm).  Add new ones at the end.

Q1      EQU 0C0H
Q0      EQU 0C1H
QM1     EQU 0C3H        ; -1
QI64    EQU 0C5H
QHALF   EQU 0C6H
QMU     EQU 0C7H        ; 1 um
Q90     EQU 0C8H
Q1000   EQU 0C9H
QNEAR   EQU 0CAH        ; numbers this close are equal
Q502    EQU 0CBH        ; halves of a um, and what lies 2 nm below
QEPS    EQU 0CCH        ; directions this close (rad) are one line
Q10     EQU 0CDH
QI180   EQU 0CEH        ; 1/180

; The table begins with Y (1,0,0), from whose 0 on stands O (0,0), from the next one X (0,-1,0):
; FIND (parser.asm) finds them there; so all three must begin in one page (a test looks).
CONTAB: DB      81H,00H,00H,00H,00H     ; 1
        DB      0,0,0,0,0               ; 0
        DB      0,0,0,0,0
        DB      81H,80H,00H,00H,00H     ; -1
        DB      0,0,0,0,0
        DB      7BH,00H,00H,00H,00H     ; 1/64
        DB      80H,00H,00H,00H,00H     ; 0.5
        DB      77H,03H,12H,6EH,98H     ; 0.001
        DB      87H,34H,00H,00H,00H     ; 90
        DB      8AH,7AH,00H,00H,00H     ; 1000
        DB      69H,56H,0BFH,94H,0D6H   ; 1E-7
        DB      80H,00H,83H,12H,6FH     ; 0.502
        DB      70H,27H,0C5H,0ACH,47H   ; 1E-5
        DB      84H,20H,00H,00H,00H     ; 10
        DB      79H,36H,0BH,60H,0B6H    ; 1/180
