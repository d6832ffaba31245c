/* The 8080's instruction table: opcode, length in bytes, cycles (of the path not taken), what it does.
 *
 * Included by each file with a loop, which gives the words of the third column their meaning (i8080_words.h).
 * A * marks the undocumented duplicates, which the silicon carries out like the opcode they double.
 * A body that writes memory does so before it changes any register: the fast loop may leave it at the write
 * and have the whole instruction carried out by the careful one.
 */
#define OP_00 1,  4, NOP                                   /* NOP */
#define OP_01 3, 10, SET_BC(IMM16)                         /* LXI B */
#define OP_02 1,  7, WR(GET_BC, a)                         /* STAX B */
#define OP_03 1,  5, SET_BC((GET_BC + 1) & 0xffff)         /* INX B */
#define OP_04 1,  5, INR(B)                                /* INR B */
#define OP_05 1,  5, DCR(B)                                /* DCR B */
#define OP_06 2,  7, SET_B(IMM8)                           /* MVI B */
#define OP_07 1,  4, RLC                                   /* RLC */
#define OP_08 1,  4, NOP                                   /* NOP* */
#define OP_09 1, 10, DAD(GET_BC)                           /* DAD B */
#define OP_0A 1,  7, SET_A(RD(GET_BC))                     /* LDAX B */
#define OP_0B 1,  5, SET_BC((GET_BC - 1) & 0xffff)         /* DCX B */
#define OP_0C 1,  5, INR(C)                                /* INR C */
#define OP_0D 1,  5, DCR(C)                                /* DCR C */
#define OP_0E 2,  7, SET_C(IMM8)                           /* MVI C */
#define OP_0F 1,  4, RRC                                   /* RRC */
#define OP_10 1,  4, NOP                                   /* NOP* */
#define OP_11 3, 10, SET_DE(IMM16)                         /* LXI D */
#define OP_12 1,  7, WR(GET_DE, a)                         /* STAX D */
#define OP_13 1,  5, SET_DE((GET_DE + 1) & 0xffff)         /* INX D */
#define OP_14 1,  5, INR(D)                                /* INR D */
#define OP_15 1,  5, DCR(D)                                /* DCR D */
#define OP_16 2,  7, SET_D(IMM8)                           /* MVI D */
#define OP_17 1,  4, RAL                                   /* RAL */
#define OP_18 1,  4, NOP                                   /* NOP* */
#define OP_19 1, 10, DAD(GET_DE)                           /* DAD D */
#define OP_1A 1,  7, SET_A(RD(GET_DE))                     /* LDAX D */
#define OP_1B 1,  5, SET_DE((GET_DE - 1) & 0xffff)         /* DCX D */
#define OP_1C 1,  5, INR(E)                                /* INR E */
#define OP_1D 1,  5, DCR(E)                                /* DCR E */
#define OP_1E 2,  7, SET_E(IMM8)                           /* MVI E */
#define OP_1F 1,  4, RAR                                   /* RAR */
#define OP_20 1,  4, NOP                                   /* NOP* */
#define OP_21 3, 10, SET_HL(IMM16)                         /* LXI H */
#define OP_22 3, 16, WR16(IMM16, hl)                       /* SHLD */
#define OP_23 1,  5, SET_HL((GET_HL + 1) & 0xffff)         /* INX H */
#define OP_24 1,  5, INR(H)                                /* INR H */
#define OP_25 1,  5, DCR(H)                                /* DCR H */
#define OP_26 2,  7, SET_H(IMM8)                           /* MVI H */
#define OP_27 1,  4, DAA                                   /* DAA */
#define OP_28 1,  4, NOP                                   /* NOP* */
#define OP_29 1, 10, DAD(GET_HL)                           /* DAD H */
#define OP_2A 3, 16, hl = RD16(IMM16)                      /* LHLD */
#define OP_2B 1,  5, SET_HL((GET_HL - 1) & 0xffff)         /* DCX H */
#define OP_2C 1,  5, INR(L)                                /* INR L */
#define OP_2D 1,  5, DCR(L)                                /* DCR L */
#define OP_2E 2,  7, SET_L(IMM8)                           /* MVI L */
#define OP_2F 1,  4, CMA                                   /* CMA */
#define OP_30 1,  4, NOP                                   /* NOP* */
#define OP_31 3, 10, SET_SP(IMM16)                         /* LXI SP */
#define OP_32 3, 13, WR(IMM16, a)                          /* STA */
#define OP_33 1,  5, SET_SP((GET_SP + 1) & 0xffff)         /* INX SP */
#define OP_34 1, 10, INR(M)                                /* INR M */
#define OP_35 1, 10, DCR(M)                                /* DCR M */
#define OP_36 2, 10, SET_M(IMM8)                           /* MVI M */
#define OP_37 1,  4, STC                                   /* STC */
#define OP_38 1,  4, NOP                                   /* NOP* */
#define OP_39 1, 10, DAD(GET_SP)                           /* DAD SP */
#define OP_3A 3, 13, SET_A(RD(IMM16))                      /* LDA */
#define OP_3B 1,  5, SET_SP((GET_SP - 1) & 0xffff)         /* DCX SP */
#define OP_3C 1,  5, INR(A)                                /* INR A */
#define OP_3D 1,  5, DCR(A)                                /* DCR A */
#define OP_3E 2,  7, SET_A(IMM8)                           /* MVI A */
#define OP_3F 1,  4, CMC                                   /* CMC */
#define OP_40 1,  5, NOP                                   /* MOV B,B */
#define OP_41 1,  5, SET_B(GET_C)                          /* MOV B,C */
#define OP_42 1,  5, SET_B(GET_D)                          /* MOV B,D */
#define OP_43 1,  5, SET_B(GET_E)                          /* MOV B,E */
#define OP_44 1,  5, SET_B(GET_H)                          /* MOV B,H */
#define OP_45 1,  5, SET_B(GET_L)                          /* MOV B,L */
#define OP_46 1,  7, SET_B(GET_M)                          /* MOV B,M */
#define OP_47 1,  5, SET_B(GET_A)                          /* MOV B,A */
#define OP_48 1,  5, SET_C(GET_B)                          /* MOV C,B */
#define OP_49 1,  5, NOP                                   /* MOV C,C */
#define OP_4A 1,  5, SET_C(GET_D)                          /* MOV C,D */
#define OP_4B 1,  5, SET_C(GET_E)                          /* MOV C,E */
#define OP_4C 1,  5, SET_C(GET_H)                          /* MOV C,H */
#define OP_4D 1,  5, SET_C(GET_L)                          /* MOV C,L */
#define OP_4E 1,  7, SET_C(GET_M)                          /* MOV C,M */
#define OP_4F 1,  5, SET_C(GET_A)                          /* MOV C,A */
#define OP_50 1,  5, SET_D(GET_B)                          /* MOV D,B */
#define OP_51 1,  5, SET_D(GET_C)                          /* MOV D,C */
#define OP_52 1,  5, NOP                                   /* MOV D,D */
#define OP_53 1,  5, SET_D(GET_E)                          /* MOV D,E */
#define OP_54 1,  5, SET_D(GET_H)                          /* MOV D,H */
#define OP_55 1,  5, SET_D(GET_L)                          /* MOV D,L */
#define OP_56 1,  7, SET_D(GET_M)                          /* MOV D,M */
#define OP_57 1,  5, SET_D(GET_A)                          /* MOV D,A */
#define OP_58 1,  5, SET_E(GET_B)                          /* MOV E,B */
#define OP_59 1,  5, SET_E(GET_C)                          /* MOV E,C */
#define OP_5A 1,  5, SET_E(GET_D)                          /* MOV E,D */
#define OP_5B 1,  5, NOP                                   /* MOV E,E */
#define OP_5C 1,  5, SET_E(GET_H)                          /* MOV E,H */
#define OP_5D 1,  5, SET_E(GET_L)                          /* MOV E,L */
#define OP_5E 1,  7, SET_E(GET_M)                          /* MOV E,M */
#define OP_5F 1,  5, SET_E(GET_A)                          /* MOV E,A */
#define OP_60 1,  5, SET_H(GET_B)                          /* MOV H,B */
#define OP_61 1,  5, SET_H(GET_C)                          /* MOV H,C */
#define OP_62 1,  5, SET_H(GET_D)                          /* MOV H,D */
#define OP_63 1,  5, SET_H(GET_E)                          /* MOV H,E */
#define OP_64 1,  5, NOP                                   /* MOV H,H */
#define OP_65 1,  5, SET_H(GET_L)                          /* MOV H,L */
#define OP_66 1,  7, SET_H(GET_M)                          /* MOV H,M */
#define OP_67 1,  5, SET_H(GET_A)                          /* MOV H,A */
#define OP_68 1,  5, SET_L(GET_B)                          /* MOV L,B */
#define OP_69 1,  5, SET_L(GET_C)                          /* MOV L,C */
#define OP_6A 1,  5, SET_L(GET_D)                          /* MOV L,D */
#define OP_6B 1,  5, SET_L(GET_E)                          /* MOV L,E */
#define OP_6C 1,  5, SET_L(GET_H)                          /* MOV L,H */
#define OP_6D 1,  5, NOP                                   /* MOV L,L */
#define OP_6E 1,  7, SET_L(GET_M)                          /* MOV L,M */
#define OP_6F 1,  5, SET_L(GET_A)                          /* MOV L,A */
#define OP_70 1,  7, SET_M(GET_B)                          /* MOV M,B */
#define OP_71 1,  7, SET_M(GET_C)                          /* MOV M,C */
#define OP_72 1,  7, SET_M(GET_D)                          /* MOV M,D */
#define OP_73 1,  7, SET_M(GET_E)                          /* MOV M,E */
#define OP_74 1,  7, SET_M(GET_H)                          /* MOV M,H */
#define OP_75 1,  7, SET_M(GET_L)                          /* MOV M,L */
#define OP_76 1,  7, HLT                                   /* HLT */
#define OP_77 1,  7, SET_M(GET_A)                          /* MOV M,A */
#define OP_78 1,  5, SET_A(GET_B)                          /* MOV A,B */
#define OP_79 1,  5, SET_A(GET_C)                          /* MOV A,C */
#define OP_7A 1,  5, SET_A(GET_D)                          /* MOV A,D */
#define OP_7B 1,  5, SET_A(GET_E)                          /* MOV A,E */
#define OP_7C 1,  5, SET_A(GET_H)                          /* MOV A,H */
#define OP_7D 1,  5, SET_A(GET_L)                          /* MOV A,L */
#define OP_7E 1,  7, SET_A(GET_M)                          /* MOV A,M */
#define OP_7F 1,  5, NOP                                   /* MOV A,A */
#define OP_80 1,  4, ADD(GET_B)                            /* ADD B */
#define OP_81 1,  4, ADD(GET_C)                            /* ADD C */
#define OP_82 1,  4, ADD(GET_D)                            /* ADD D */
#define OP_83 1,  4, ADD(GET_E)                            /* ADD E */
#define OP_84 1,  4, ADD(GET_H)                            /* ADD H */
#define OP_85 1,  4, ADD(GET_L)                            /* ADD L */
#define OP_86 1,  7, ADD(GET_M)                            /* ADD M */
#define OP_87 1,  4, ADD(GET_A)                            /* ADD A */
#define OP_88 1,  4, ADC(GET_B)                            /* ADC B */
#define OP_89 1,  4, ADC(GET_C)                            /* ADC C */
#define OP_8A 1,  4, ADC(GET_D)                            /* ADC D */
#define OP_8B 1,  4, ADC(GET_E)                            /* ADC E */
#define OP_8C 1,  4, ADC(GET_H)                            /* ADC H */
#define OP_8D 1,  4, ADC(GET_L)                            /* ADC L */
#define OP_8E 1,  7, ADC(GET_M)                            /* ADC M */
#define OP_8F 1,  4, ADC(GET_A)                            /* ADC A */
#define OP_90 1,  4, SUB(GET_B)                            /* SUB B */
#define OP_91 1,  4, SUB(GET_C)                            /* SUB C */
#define OP_92 1,  4, SUB(GET_D)                            /* SUB D */
#define OP_93 1,  4, SUB(GET_E)                            /* SUB E */
#define OP_94 1,  4, SUB(GET_H)                            /* SUB H */
#define OP_95 1,  4, SUB(GET_L)                            /* SUB L */
#define OP_96 1,  7, SUB(GET_M)                            /* SUB M */
#define OP_97 1,  4, SUB(GET_A)                            /* SUB A */
#define OP_98 1,  4, SBB(GET_B)                            /* SBB B */
#define OP_99 1,  4, SBB(GET_C)                            /* SBB C */
#define OP_9A 1,  4, SBB(GET_D)                            /* SBB D */
#define OP_9B 1,  4, SBB(GET_E)                            /* SBB E */
#define OP_9C 1,  4, SBB(GET_H)                            /* SBB H */
#define OP_9D 1,  4, SBB(GET_L)                            /* SBB L */
#define OP_9E 1,  7, SBB(GET_M)                            /* SBB M */
#define OP_9F 1,  4, SBB(GET_A)                            /* SBB A */
#define OP_A0 1,  4, ANA(GET_B)                            /* ANA B */
#define OP_A1 1,  4, ANA(GET_C)                            /* ANA C */
#define OP_A2 1,  4, ANA(GET_D)                            /* ANA D */
#define OP_A3 1,  4, ANA(GET_E)                            /* ANA E */
#define OP_A4 1,  4, ANA(GET_H)                            /* ANA H */
#define OP_A5 1,  4, ANA(GET_L)                            /* ANA L */
#define OP_A6 1,  7, ANA(GET_M)                            /* ANA M */
#define OP_A7 1,  4, ANA(GET_A)                            /* ANA A */
#define OP_A8 1,  4, XRA(GET_B)                            /* XRA B */
#define OP_A9 1,  4, XRA(GET_C)                            /* XRA C */
#define OP_AA 1,  4, XRA(GET_D)                            /* XRA D */
#define OP_AB 1,  4, XRA(GET_E)                            /* XRA E */
#define OP_AC 1,  4, XRA(GET_H)                            /* XRA H */
#define OP_AD 1,  4, XRA(GET_L)                            /* XRA L */
#define OP_AE 1,  7, XRA(GET_M)                            /* XRA M */
#define OP_AF 1,  4, XRA(GET_A)                            /* XRA A */
#define OP_B0 1,  4, ORA(GET_B)                            /* ORA B */
#define OP_B1 1,  4, ORA(GET_C)                            /* ORA C */
#define OP_B2 1,  4, ORA(GET_D)                            /* ORA D */
#define OP_B3 1,  4, ORA(GET_E)                            /* ORA E */
#define OP_B4 1,  4, ORA(GET_H)                            /* ORA H */
#define OP_B5 1,  4, ORA(GET_L)                            /* ORA L */
#define OP_B6 1,  7, ORA(GET_M)                            /* ORA M */
#define OP_B7 1,  4, ORA(GET_A)                            /* ORA A */
#define OP_B8 1,  4, CMP(GET_B)                            /* CMP B */
#define OP_B9 1,  4, CMP(GET_C)                            /* CMP C */
#define OP_BA 1,  4, CMP(GET_D)                            /* CMP D */
#define OP_BB 1,  4, CMP(GET_E)                            /* CMP E */
#define OP_BC 1,  4, CMP(GET_H)                            /* CMP H */
#define OP_BD 1,  4, CMP(GET_L)                            /* CMP L */
#define OP_BE 1,  7, CMP(GET_M)                            /* CMP M */
#define OP_BF 1,  4, CMP(GET_A)                            /* CMP A */
#define OP_C0 1,  5, RETURN_IF(!Z)                         /* RNZ */
#define OP_C1 1, 10, POP(BC)                               /* POP B */
#define OP_C2 3, 10, JUMP_IF(!Z)                           /* JNZ */
#define OP_C3 3, 10, JUMP                                  /* JMP */
#define OP_C4 3, 11, CALL_IF(!Z)                           /* CNZ */
#define OP_C5 1, 11, PUSH(GET_BC)                          /* PUSH B */
#define OP_C6 2,  7, ADD(IMM8)                             /* ADI */
#define OP_C7 1, 11, RST(0)                                /* RST 0 */
#define OP_C8 1,  5, RETURN_IF(Z)                          /* RZ */
#define OP_C9 1, 10, RETURN                                /* RET */
#define OP_CA 3, 10, JUMP_IF(Z)                            /* JZ */
#define OP_CB 3, 10, JUMP                                  /* JMP* */
#define OP_CC 3, 11, CALL_IF(Z)                            /* CZ */
#define OP_CD 3, 17, CALL                                  /* CALL */
#define OP_CE 2,  7, ADC(IMM8)                             /* ACI */
#define OP_CF 1, 11, RST(8)                                /* RST 1 */
#define OP_D0 1,  5, RETURN_IF(!CY)                        /* RNC */
#define OP_D1 1, 10, POP(DE)                               /* POP D */
#define OP_D2 3, 10, JUMP_IF(!CY)                          /* JNC */
#define OP_D3 2, 10, OUT                                   /* OUT */
#define OP_D4 3, 11, CALL_IF(!CY)                          /* CNC */
#define OP_D5 1, 11, PUSH(GET_DE)                          /* PUSH D */
#define OP_D6 2,  7, SUB(IMM8)                             /* SUI */
#define OP_D7 1, 11, RST(16)                               /* RST 2 */
#define OP_D8 1,  5, RETURN_IF(CY)                         /* RC */
#define OP_D9 1, 10, RETURN                                /* RET* */
#define OP_DA 3, 10, JUMP_IF(CY)                           /* JC */
#define OP_DB 2, 10, IN                                    /* IN */
#define OP_DC 3, 11, CALL_IF(CY)                           /* CC */
#define OP_DD 3, 17, CALL                                  /* CALL* */
#define OP_DE 2,  7, SBB(IMM8)                             /* SBI */
#define OP_DF 1, 11, RST(24)                               /* RST 3 */
#define OP_E0 1,  5, RETURN_IF(PO)                         /* RPO */
#define OP_E1 1, 10, POP(HL)                               /* POP H */
#define OP_E2 3, 10, JUMP_IF(PO)                           /* JPO */
#define OP_E3 1, 18, XTHL                                  /* XTHL */
#define OP_E4 3, 11, CALL_IF(PO)                           /* CPO */
#define OP_E5 1, 11, PUSH(GET_HL)                          /* PUSH H */
#define OP_E6 2,  7, ANA(IMM8)                             /* ANI */
#define OP_E7 1, 11, RST(32)                               /* RST 4 */
#define OP_E8 1,  5, RETURN_IF(PE)                         /* RPE */
#define OP_E9 1,  5, PCHL                                  /* PCHL */
#define OP_EA 3, 10, JUMP_IF(PE)                           /* JPE */
#define OP_EB 1,  4, XCHG                                  /* XCHG */
#define OP_EC 3, 11, CALL_IF(PE)                           /* CPE */
#define OP_ED 3, 17, CALL                                  /* CALL* */
#define OP_EE 2,  7, XRA(IMM8)                             /* XRI */
#define OP_EF 1, 11, RST(40)                               /* RST 5 */
#define OP_F0 1,  5, RETURN_IF(!S)                         /* RP */
#define OP_F1 1, 10, POP(PSW)                              /* POP PSW */
#define OP_F2 3, 10, JUMP_IF(!S)                           /* JP */
#define OP_F3 1,  4, DI                                    /* DI */
#define OP_F4 3, 11, CALL_IF(!S)                           /* CP */
#define OP_F5 1, 11, PUSH(GET_PSW)                         /* PUSH PSW */
#define OP_F6 2,  7, ORA(IMM8)                             /* ORI */
#define OP_F7 1, 11, RST(48)                               /* RST 6 */
#define OP_F8 1,  5, RETURN_IF(S)                          /* RM */
#define OP_F9 1,  5, sp = hl                               /* SPHL */
#define OP_FA 3, 10, JUMP_IF(S)                            /* JM */
#define OP_FB 1,  4, EI                                    /* EI */
#define OP_FC 3, 11, CALL_IF(S)                            /* CM */
#define OP_FD 3, 17, CALL                                  /* CALL* */
#define OP_FE 2,  7, CMP(IMM8)                             /* CPI */
#define OP_FF 1, 11, RST(56)                               /* RST 7 */

#define EVERY_OPCODE(X) \
    X(00) X(01) X(02) X(03) X(04) X(05) X(06) X(07) X(08) X(09) X(0A) X(0B) X(0C) X(0D) X(0E) X(0F) \
    X(10) X(11) X(12) X(13) X(14) X(15) X(16) X(17) X(18) X(19) X(1A) X(1B) X(1C) X(1D) X(1E) X(1F) \
    X(20) X(21) X(22) X(23) X(24) X(25) X(26) X(27) X(28) X(29) X(2A) X(2B) X(2C) X(2D) X(2E) X(2F) \
    X(30) X(31) X(32) X(33) X(34) X(35) X(36) X(37) X(38) X(39) X(3A) X(3B) X(3C) X(3D) X(3E) X(3F) \
    X(40) X(41) X(42) X(43) X(44) X(45) X(46) X(47) X(48) X(49) X(4A) X(4B) X(4C) X(4D) X(4E) X(4F) \
    X(50) X(51) X(52) X(53) X(54) X(55) X(56) X(57) X(58) X(59) X(5A) X(5B) X(5C) X(5D) X(5E) X(5F) \
    X(60) X(61) X(62) X(63) X(64) X(65) X(66) X(67) X(68) X(69) X(6A) X(6B) X(6C) X(6D) X(6E) X(6F) \
    X(70) X(71) X(72) X(73) X(74) X(75) X(76) X(77) X(78) X(79) X(7A) X(7B) X(7C) X(7D) X(7E) X(7F) \
    X(80) X(81) X(82) X(83) X(84) X(85) X(86) X(87) X(88) X(89) X(8A) X(8B) X(8C) X(8D) X(8E) X(8F) \
    X(90) X(91) X(92) X(93) X(94) X(95) X(96) X(97) X(98) X(99) X(9A) X(9B) X(9C) X(9D) X(9E) X(9F) \
    X(A0) X(A1) X(A2) X(A3) X(A4) X(A5) X(A6) X(A7) X(A8) X(A9) X(AA) X(AB) X(AC) X(AD) X(AE) X(AF) \
    X(B0) X(B1) X(B2) X(B3) X(B4) X(B5) X(B6) X(B7) X(B8) X(B9) X(BA) X(BB) X(BC) X(BD) X(BE) X(BF) \
    X(C0) X(C1) X(C2) X(C3) X(C4) X(C5) X(C6) X(C7) X(C8) X(C9) X(CA) X(CB) X(CC) X(CD) X(CE) X(CF) \
    X(D0) X(D1) X(D2) X(D3) X(D4) X(D5) X(D6) X(D7) X(D8) X(D9) X(DA) X(DB) X(DC) X(DD) X(DE) X(DF) \
    X(E0) X(E1) X(E2) X(E3) X(E4) X(E5) X(E6) X(E7) X(E8) X(E9) X(EA) X(EB) X(EC) X(ED) X(EE) X(EF) \
    X(F0) X(F1) X(F2) X(F3) X(F4) X(F5) X(F6) X(F7) X(F8) X(F9) X(FA) X(FB) X(FC) X(FD) X(FE) X(FF)
