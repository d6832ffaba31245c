; repeat.asm - statements that do not work yet: ERR 01
SSCALE:
SSYM:
SREP:
SRECUT:
SFIT:   JMP     ERSYN
