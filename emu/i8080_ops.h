/* The 8080's instruction table: opcode, length in bytes, cycles (of the path not taken), what it does.
 *
 * Included by i8080.c, once for each of its two loops, with OP() and the words of the third column defined there.
 * A * marks the undocumented duplicates, which the silicon carries out like the opcode they double.
 * A body that writes memory does so before it changes any register: the fast loop may leave it at the write
 * and have the whole instruction carried out by the careful one.
 */
    OP(00, 1,  4, NOP)                             /* NOP */
    OP(01, 3, 10, SET_BC(IMM16))                   /* LXI B */
    OP(02, 1,  7, WR(GET_BC, a))                   /* STAX B */
    OP(03, 1,  5, SET_BC((GET_BC + 1) & 0xffff))   /* INX B */
    OP(04, 1,  5, INR(B))                          /* INR B */
    OP(05, 1,  5, DCR(B))                          /* DCR B */
    OP(06, 2,  7, SET_B(IMM8))                     /* MVI B */
    OP(07, 1,  4, RLC)                             /* RLC */
    OP(08, 1,  4, NOP)                             /* NOP* */
    OP(09, 1, 10, DAD(GET_BC))                     /* DAD B */
    OP(0A, 1,  7, SET_A(RD(GET_BC)))               /* LDAX B */
    OP(0B, 1,  5, SET_BC((GET_BC - 1) & 0xffff))   /* DCX B */
    OP(0C, 1,  5, INR(C))                          /* INR C */
    OP(0D, 1,  5, DCR(C))                          /* DCR C */
    OP(0E, 2,  7, SET_C(IMM8))                     /* MVI C */
    OP(0F, 1,  4, RRC)                             /* RRC */
    OP(10, 1,  4, NOP)                             /* NOP* */
    OP(11, 3, 10, SET_DE(IMM16))                   /* LXI D */
    OP(12, 1,  7, WR(GET_DE, a))                   /* STAX D */
    OP(13, 1,  5, SET_DE((GET_DE + 1) & 0xffff))   /* INX D */
    OP(14, 1,  5, INR(D))                          /* INR D */
    OP(15, 1,  5, DCR(D))                          /* DCR D */
    OP(16, 2,  7, SET_D(IMM8))                     /* MVI D */
    OP(17, 1,  4, RAL)                             /* RAL */
    OP(18, 1,  4, NOP)                             /* NOP* */
    OP(19, 1, 10, DAD(GET_DE))                     /* DAD D */
    OP(1A, 1,  7, SET_A(RD(GET_DE)))               /* LDAX D */
    OP(1B, 1,  5, SET_DE((GET_DE - 1) & 0xffff))   /* DCX D */
    OP(1C, 1,  5, INR(E))                          /* INR E */
    OP(1D, 1,  5, DCR(E))                          /* DCR E */
    OP(1E, 2,  7, SET_E(IMM8))                     /* MVI E */
    OP(1F, 1,  4, RAR)                             /* RAR */
    OP(20, 1,  4, NOP)                             /* NOP* */
    OP(21, 3, 10, SET_HL(IMM16))                   /* LXI H */
    OP(22, 3, 16, WR16(IMM16, hl))                 /* SHLD */
    OP(23, 1,  5, SET_HL((GET_HL + 1) & 0xffff))   /* INX H */
    OP(24, 1,  5, INR(H))                          /* INR H */
    OP(25, 1,  5, DCR(H))                          /* DCR H */
    OP(26, 2,  7, SET_H(IMM8))                     /* MVI H */
    OP(27, 1,  4, DAA)                             /* DAA */
    OP(28, 1,  4, NOP)                             /* NOP* */
    OP(29, 1, 10, DAD(GET_HL))                     /* DAD H */
    OP(2A, 3, 16, hl = RD16(IMM16))                /* LHLD */
    OP(2B, 1,  5, SET_HL((GET_HL - 1) & 0xffff))   /* DCX H */
    OP(2C, 1,  5, INR(L))                          /* INR L */
    OP(2D, 1,  5, DCR(L))                          /* DCR L */
    OP(2E, 2,  7, SET_L(IMM8))                     /* MVI L */
    OP(2F, 1,  4, CMA)                             /* CMA */
    OP(30, 1,  4, NOP)                             /* NOP* */
    OP(31, 3, 10, SET_SP(IMM16))                   /* LXI SP */
    OP(32, 3, 13, WR(IMM16, a))                    /* STA */
    OP(33, 1,  5, SET_SP((GET_SP + 1) & 0xffff))   /* INX SP */
    OP(34, 1, 10, INR(M))                          /* INR M */
    OP(35, 1, 10, DCR(M))                          /* DCR M */
    OP(36, 2, 10, SET_M(IMM8))                     /* MVI M */
    OP(37, 1,  4, STC)                             /* STC */
    OP(38, 1,  4, NOP)                             /* NOP* */
    OP(39, 1, 10, DAD(GET_SP))                     /* DAD SP */
    OP(3A, 3, 13, SET_A(RD(IMM16)))                /* LDA */
    OP(3B, 1,  5, SET_SP((GET_SP - 1) & 0xffff))   /* DCX SP */
    OP(3C, 1,  5, INR(A))                          /* INR A */
    OP(3D, 1,  5, DCR(A))                          /* DCR A */
    OP(3E, 2,  7, SET_A(IMM8))                     /* MVI A */
    OP(3F, 1,  4, CMC)                             /* CMC */
    OP(40, 1,  5, NOP)                             /* MOV B,B */
    OP(41, 1,  5, SET_B(GET_C))                    /* MOV B,C */
    OP(42, 1,  5, SET_B(GET_D))                    /* MOV B,D */
    OP(43, 1,  5, SET_B(GET_E))                    /* MOV B,E */
    OP(44, 1,  5, SET_B(GET_H))                    /* MOV B,H */
    OP(45, 1,  5, SET_B(GET_L))                    /* MOV B,L */
    OP(46, 1,  7, SET_B(GET_M))                    /* MOV B,M */
    OP(47, 1,  5, SET_B(GET_A))                    /* MOV B,A */
    OP(48, 1,  5, SET_C(GET_B))                    /* MOV C,B */
    OP(49, 1,  5, NOP)                             /* MOV C,C */
    OP(4A, 1,  5, SET_C(GET_D))                    /* MOV C,D */
    OP(4B, 1,  5, SET_C(GET_E))                    /* MOV C,E */
    OP(4C, 1,  5, SET_C(GET_H))                    /* MOV C,H */
    OP(4D, 1,  5, SET_C(GET_L))                    /* MOV C,L */
    OP(4E, 1,  7, SET_C(GET_M))                    /* MOV C,M */
    OP(4F, 1,  5, SET_C(GET_A))                    /* MOV C,A */
    OP(50, 1,  5, SET_D(GET_B))                    /* MOV D,B */
    OP(51, 1,  5, SET_D(GET_C))                    /* MOV D,C */
    OP(52, 1,  5, NOP)                             /* MOV D,D */
    OP(53, 1,  5, SET_D(GET_E))                    /* MOV D,E */
    OP(54, 1,  5, SET_D(GET_H))                    /* MOV D,H */
    OP(55, 1,  5, SET_D(GET_L))                    /* MOV D,L */
    OP(56, 1,  7, SET_D(GET_M))                    /* MOV D,M */
    OP(57, 1,  5, SET_D(GET_A))                    /* MOV D,A */
    OP(58, 1,  5, SET_E(GET_B))                    /* MOV E,B */
    OP(59, 1,  5, SET_E(GET_C))                    /* MOV E,C */
    OP(5A, 1,  5, SET_E(GET_D))                    /* MOV E,D */
    OP(5B, 1,  5, NOP)                             /* MOV E,E */
    OP(5C, 1,  5, SET_E(GET_H))                    /* MOV E,H */
    OP(5D, 1,  5, SET_E(GET_L))                    /* MOV E,L */
    OP(5E, 1,  7, SET_E(GET_M))                    /* MOV E,M */
    OP(5F, 1,  5, SET_E(GET_A))                    /* MOV E,A */
    OP(60, 1,  5, SET_H(GET_B))                    /* MOV H,B */
    OP(61, 1,  5, SET_H(GET_C))                    /* MOV H,C */
    OP(62, 1,  5, SET_H(GET_D))                    /* MOV H,D */
    OP(63, 1,  5, SET_H(GET_E))                    /* MOV H,E */
    OP(64, 1,  5, NOP)                             /* MOV H,H */
    OP(65, 1,  5, SET_H(GET_L))                    /* MOV H,L */
    OP(66, 1,  7, SET_H(GET_M))                    /* MOV H,M */
    OP(67, 1,  5, SET_H(GET_A))                    /* MOV H,A */
    OP(68, 1,  5, SET_L(GET_B))                    /* MOV L,B */
    OP(69, 1,  5, SET_L(GET_C))                    /* MOV L,C */
    OP(6A, 1,  5, SET_L(GET_D))                    /* MOV L,D */
    OP(6B, 1,  5, SET_L(GET_E))                    /* MOV L,E */
    OP(6C, 1,  5, SET_L(GET_H))                    /* MOV L,H */
    OP(6D, 1,  5, NOP)                             /* MOV L,L */
    OP(6E, 1,  7, SET_L(GET_M))                    /* MOV L,M */
    OP(6F, 1,  5, SET_L(GET_A))                    /* MOV L,A */
    OP(70, 1,  7, SET_M(GET_B))                    /* MOV M,B */
    OP(71, 1,  7, SET_M(GET_C))                    /* MOV M,C */
    OP(72, 1,  7, SET_M(GET_D))                    /* MOV M,D */
    OP(73, 1,  7, SET_M(GET_E))                    /* MOV M,E */
    OP(74, 1,  7, SET_M(GET_H))                    /* MOV M,H */
    OP(75, 1,  7, SET_M(GET_L))                    /* MOV M,L */
    OP(76, 1,  7, HLT)                             /* HLT */
    OP(77, 1,  7, SET_M(GET_A))                    /* MOV M,A */
    OP(78, 1,  5, SET_A(GET_B))                    /* MOV A,B */
    OP(79, 1,  5, SET_A(GET_C))                    /* MOV A,C */
    OP(7A, 1,  5, SET_A(GET_D))                    /* MOV A,D */
    OP(7B, 1,  5, SET_A(GET_E))                    /* MOV A,E */
    OP(7C, 1,  5, SET_A(GET_H))                    /* MOV A,H */
    OP(7D, 1,  5, SET_A(GET_L))                    /* MOV A,L */
    OP(7E, 1,  7, SET_A(GET_M))                    /* MOV A,M */
    OP(7F, 1,  5, NOP)                             /* MOV A,A */
    OP(80, 1,  4, ADD(GET_B))                      /* ADD B */
    OP(81, 1,  4, ADD(GET_C))                      /* ADD C */
    OP(82, 1,  4, ADD(GET_D))                      /* ADD D */
    OP(83, 1,  4, ADD(GET_E))                      /* ADD E */
    OP(84, 1,  4, ADD(GET_H))                      /* ADD H */
    OP(85, 1,  4, ADD(GET_L))                      /* ADD L */
    OP(86, 1,  7, ADD(GET_M))                      /* ADD M */
    OP(87, 1,  4, ADD(GET_A))                      /* ADD A */
    OP(88, 1,  4, ADC(GET_B))                      /* ADC B */
    OP(89, 1,  4, ADC(GET_C))                      /* ADC C */
    OP(8A, 1,  4, ADC(GET_D))                      /* ADC D */
    OP(8B, 1,  4, ADC(GET_E))                      /* ADC E */
    OP(8C, 1,  4, ADC(GET_H))                      /* ADC H */
    OP(8D, 1,  4, ADC(GET_L))                      /* ADC L */
    OP(8E, 1,  7, ADC(GET_M))                      /* ADC M */
    OP(8F, 1,  4, ADC(GET_A))                      /* ADC A */
    OP(90, 1,  4, SUB(GET_B))                      /* SUB B */
    OP(91, 1,  4, SUB(GET_C))                      /* SUB C */
    OP(92, 1,  4, SUB(GET_D))                      /* SUB D */
    OP(93, 1,  4, SUB(GET_E))                      /* SUB E */
    OP(94, 1,  4, SUB(GET_H))                      /* SUB H */
    OP(95, 1,  4, SUB(GET_L))                      /* SUB L */
    OP(96, 1,  7, SUB(GET_M))                      /* SUB M */
    OP(97, 1,  4, SUB(GET_A))                      /* SUB A */
    OP(98, 1,  4, SBB(GET_B))                      /* SBB B */
    OP(99, 1,  4, SBB(GET_C))                      /* SBB C */
    OP(9A, 1,  4, SBB(GET_D))                      /* SBB D */
    OP(9B, 1,  4, SBB(GET_E))                      /* SBB E */
    OP(9C, 1,  4, SBB(GET_H))                      /* SBB H */
    OP(9D, 1,  4, SBB(GET_L))                      /* SBB L */
    OP(9E, 1,  7, SBB(GET_M))                      /* SBB M */
    OP(9F, 1,  4, SBB(GET_A))                      /* SBB A */
    OP(A0, 1,  4, ANA(GET_B))                      /* ANA B */
    OP(A1, 1,  4, ANA(GET_C))                      /* ANA C */
    OP(A2, 1,  4, ANA(GET_D))                      /* ANA D */
    OP(A3, 1,  4, ANA(GET_E))                      /* ANA E */
    OP(A4, 1,  4, ANA(GET_H))                      /* ANA H */
    OP(A5, 1,  4, ANA(GET_L))                      /* ANA L */
    OP(A6, 1,  7, ANA(GET_M))                      /* ANA M */
    OP(A7, 1,  4, ANA(GET_A))                      /* ANA A */
    OP(A8, 1,  4, XRA(GET_B))                      /* XRA B */
    OP(A9, 1,  4, XRA(GET_C))                      /* XRA C */
    OP(AA, 1,  4, XRA(GET_D))                      /* XRA D */
    OP(AB, 1,  4, XRA(GET_E))                      /* XRA E */
    OP(AC, 1,  4, XRA(GET_H))                      /* XRA H */
    OP(AD, 1,  4, XRA(GET_L))                      /* XRA L */
    OP(AE, 1,  7, XRA(GET_M))                      /* XRA M */
    OP(AF, 1,  4, XRA(GET_A))                      /* XRA A */
    OP(B0, 1,  4, ORA(GET_B))                      /* ORA B */
    OP(B1, 1,  4, ORA(GET_C))                      /* ORA C */
    OP(B2, 1,  4, ORA(GET_D))                      /* ORA D */
    OP(B3, 1,  4, ORA(GET_E))                      /* ORA E */
    OP(B4, 1,  4, ORA(GET_H))                      /* ORA H */
    OP(B5, 1,  4, ORA(GET_L))                      /* ORA L */
    OP(B6, 1,  7, ORA(GET_M))                      /* ORA M */
    OP(B7, 1,  4, ORA(GET_A))                      /* ORA A */
    OP(B8, 1,  4, CMP(GET_B))                      /* CMP B */
    OP(B9, 1,  4, CMP(GET_C))                      /* CMP C */
    OP(BA, 1,  4, CMP(GET_D))                      /* CMP D */
    OP(BB, 1,  4, CMP(GET_E))                      /* CMP E */
    OP(BC, 1,  4, CMP(GET_H))                      /* CMP H */
    OP(BD, 1,  4, CMP(GET_L))                      /* CMP L */
    OP(BE, 1,  7, CMP(GET_M))                      /* CMP M */
    OP(BF, 1,  4, CMP(GET_A))                      /* CMP A */
    OP(C0, 1,  5, RETURN_IF(!Z))                   /* RNZ */
    OP(C1, 1, 10, POP(BC))                         /* POP B */
    OP(C2, 3, 10, JUMP_IF(!Z))                     /* JNZ */
    OP(C3, 3, 10, JUMP)                            /* JMP */
    OP(C4, 3, 11, CALL_IF(!Z))                     /* CNZ */
    OP(C5, 1, 11, PUSH(GET_BC))                    /* PUSH B */
    OP(C6, 2,  7, ADD(IMM8))                       /* ADI */
    OP(C7, 1, 11, RST(0))                          /* RST 0 */
    OP(C8, 1,  5, RETURN_IF(Z))                    /* RZ */
    OP(C9, 1, 10, RETURN)                          /* RET */
    OP(CA, 3, 10, JUMP_IF(Z))                      /* JZ */
    OP(CB, 3, 10, JUMP)                            /* JMP* */
    OP(CC, 3, 11, CALL_IF(Z))                      /* CZ */
    OP(CD, 3, 17, CALL)                            /* CALL */
    OP(CE, 2,  7, ADC(IMM8))                       /* ACI */
    OP(CF, 1, 11, RST(8))                          /* RST 1 */
    OP(D0, 1,  5, RETURN_IF(!CY))                  /* RNC */
    OP(D1, 1, 10, POP(DE))                         /* POP D */
    OP(D2, 3, 10, JUMP_IF(!CY))                    /* JNC */
    OP(D3, 2, 10, OUT)                             /* OUT */
    OP(D4, 3, 11, CALL_IF(!CY))                    /* CNC */
    OP(D5, 1, 11, PUSH(GET_DE))                    /* PUSH D */
    OP(D6, 2,  7, SUB(IMM8))                       /* SUI */
    OP(D7, 1, 11, RST(16))                         /* RST 2 */
    OP(D8, 1,  5, RETURN_IF(CY))                   /* RC */
    OP(D9, 1, 10, RETURN)                          /* RET* */
    OP(DA, 3, 10, JUMP_IF(CY))                     /* JC */
    OP(DB, 2, 10, IN)                              /* IN */
    OP(DC, 3, 11, CALL_IF(CY))                     /* CC */
    OP(DD, 3, 17, CALL)                            /* CALL* */
    OP(DE, 2,  7, SBB(IMM8))                       /* SBI */
    OP(DF, 1, 11, RST(24))                         /* RST 3 */
    OP(E0, 1,  5, RETURN_IF(PO))                   /* RPO */
    OP(E1, 1, 10, POP(HL))                         /* POP H */
    OP(E2, 3, 10, JUMP_IF(PO))                     /* JPO */
    OP(E3, 1, 18, XTHL)                            /* XTHL */
    OP(E4, 3, 11, CALL_IF(PO))                     /* CPO */
    OP(E5, 1, 11, PUSH(GET_HL))                    /* PUSH H */
    OP(E6, 2,  7, ANA(IMM8))                       /* ANI */
    OP(E7, 1, 11, RST(32))                         /* RST 4 */
    OP(E8, 1,  5, RETURN_IF(PE))                   /* RPE */
    OP(E9, 1,  5, PCHL)                            /* PCHL */
    OP(EA, 3, 10, JUMP_IF(PE))                     /* JPE */
    OP(EB, 1,  4, XCHG)                            /* XCHG */
    OP(EC, 3, 11, CALL_IF(PE))                     /* CPE */
    OP(ED, 3, 17, CALL)                            /* CALL* */
    OP(EE, 2,  7, XRA(IMM8))                       /* XRI */
    OP(EF, 1, 11, RST(40))                         /* RST 5 */
    OP(F0, 1,  5, RETURN_IF(!S))                   /* RP */
    OP(F1, 1, 10, POP(PSW))                        /* POP PSW */
    OP(F2, 3, 10, JUMP_IF(!S))                     /* JP */
    OP(F3, 1,  4, DI)                              /* DI */
    OP(F4, 3, 11, CALL_IF(!S))                     /* CP */
    OP(F5, 1, 11, PUSH(GET_PSW))                   /* PUSH PSW */
    OP(F6, 2,  7, ORA(IMM8))                       /* ORI */
    OP(F7, 1, 11, RST(48))                         /* RST 6 */
    OP(F8, 1,  5, RETURN_IF(S))                    /* RM */
    OP(F9, 1,  5, sp = hl)                         /* SPHL */
    OP(FA, 3, 10, JUMP_IF(S))                      /* JM */
    OP(FB, 1,  4, EI)                              /* EI */
    OP(FC, 3, 11, CALL_IF(S))                      /* CM */
    OP(FD, 3, 17, CALL)                            /* CALL* */
    OP(FE, 2,  7, CMP(IMM8))                       /* CPI */
    OP(FF, 1, 11, RST(56))                         /* RST 7 */
