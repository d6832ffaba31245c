/* Sequences of instructions that 8080 programs are full of: ends of loops, walks through memory, 16-bit arithmetic,
 * tests, registers saved. The fast loop carries out each of them as one, see i8080.c. Sorted by the first opcode, longer
 * ones first; every opcode but the last goes on to the next instruction.
 */
#define EVERY_CHAIN(CHAIN2, CHAIN3) \
    CHAIN2(05, C2)        /* DCR B; JNZ                            */ \
    CHAIN3(0A, 03, FE)    /* LDAX B; INX B; CPI                 */ \
    CHAIN2(0A, 03)        /* LDAX B; INX B                      */ \
    CHAIN2(0B, 78)        /* DCX B; MOV A,B                        */ \
    CHAIN2(0D, C2)        /* DCR C; JNZ                            */ \
    CHAIN2(0F, 0F)        /* RRC; RRC                              */ \
    CHAIN2(12, 13)        /* STAX D; INX D                         */ \
    CHAIN2(12, 23)        /* STAX D; INX H                         */ \
    CHAIN3(13, 05, C2)    /* INX D; DCR B; JNZ                     */ \
    CHAIN3(13, 0D, C2)    /* INX D; DCR C; JNZ                     */ \
    CHAIN3(13, 23, 0D)    /* INX D; INX H; DCR C                   */ \
    CHAIN3(13, 23, 05)    /* INX D; INX H; DCR B                   */ \
    CHAIN3(13, 23, 1A)    /* INX D; INX H; LDAX D               */ \
    CHAIN2(13, 23)        /* INX D; INX H                          */ \
    CHAIN2(15, C2)        /* DCR D; JNZ                            */ \
    CHAIN2(17, D2)        /* RAL; JNC                              */ \
    CHAIN2(19, EB)        /* DAD D; XCHG                           */ \
    CHAIN3(1A, 77, 13)    /* LDAX D; MOV M,A; INX D             */ \
    CHAIN3(1A, 13, B7)    /* LDAX D; INX D; ORA A               */ \
    CHAIN2(1A, 13)        /* LDAX D; INX D                         */ \
    CHAIN2(1A, 77)        /* LDAX D; MOV M,A                       */ \
    CHAIN2(1A, 86)        /* LDAX D; ADD M                         */ \
    CHAIN2(1A, 8E)        /* LDAX D; ADC M                         */ \
    CHAIN2(1A, 96)        /* LDAX D; SUB M                         */ \
    CHAIN2(1A, 9E)        /* LDAX D; SBB M                         */ \
    CHAIN2(1A, AE)        /* LDAX D; XRA M                         */ \
    CHAIN2(1A, BE)        /* LDAX D; CMP M                         */ \
    CHAIN2(1B, 7A)        /* DCX D; MOV A,D                        */ \
    CHAIN2(1D, C2)        /* DCR E; JNZ                            */ \
    CHAIN2(1F, D2)        /* RAR; JNC                              */ \
    CHAIN2(21, E5)        /* LXI H; PUSH H                      */ \
    CHAIN2(21, 7E)        /* LXI H; MOV A,M                     */ \
    CHAIN3(23, 05, C2)    /* INX H; DCR B; JNZ                     */ \
    CHAIN3(23, 0D, C2)    /* INX H; DCR C; JNZ                     */ \
    CHAIN3(23, 13, 0D)    /* INX H; INX D; DCR C                   */ \
    CHAIN3(23, 13, 05)    /* INX H; INX D; DCR B                   */ \
    CHAIN3(23, 1A, 77)    /* INX H; LDAX D; MOV M,A             */ \
    CHAIN2(23, 13)        /* INX H; INX D                          */ \
    CHAIN2(23, 7E)        /* INX H; MOV A,M                        */ \
    CHAIN2(23, 77)        /* INX H; MOV M,A                        */ \
    CHAIN2(23, 46)        /* INX H; MOV B,M                        */ \
    CHAIN2(23, 70)        /* INX H; MOV M,B                        */ \
    CHAIN2(23, 4E)        /* INX H; MOV C,M                        */ \
    CHAIN2(23, 71)        /* INX H; MOV M,C                        */ \
    CHAIN2(23, 56)        /* INX H; MOV D,M                        */ \
    CHAIN2(23, 72)        /* INX H; MOV M,D                        */ \
    CHAIN2(23, 5E)        /* INX H; MOV E,M                        */ \
    CHAIN2(23, 73)        /* INX H; MOV M,E                        */ \
    CHAIN2(25, C2)        /* DCR H; JNZ                            */ \
    CHAIN3(26, 5E, 23)    /* MVI H; MOV E,M; INX H              */ \
    CHAIN3(27, 77, 23)    /* DAA; MOV M,A; INX H                   */ \
    CHAIN3(29, 17, D2)    /* DAD H; RAL; JNC                    */ \
    CHAIN2(29, 17)        /* DAD H; RAL                            */ \
    CHAIN2(29, 29)        /* DAD H; DAD H                          */ \
    CHAIN2(29, D2)        /* DAD H; JNC                            */ \
    CHAIN2(29, DA)        /* DAD H; JC                             */ \
    CHAIN2(29, 8F)        /* DAD H; ADC A                          */ \
    CHAIN3(2A, 7D, D6)    /* LHLD; MOV A,L; SUI                 */ \
    CHAIN2(2A, 7D)        /* LHLD; MOV A,L                      */ \
    CHAIN2(2B, 7E)        /* DCX H; MOV A,M                        */ \
    CHAIN2(2B, 46)        /* DCX H; MOV B,M                        */ \
    CHAIN2(2B, 4E)        /* DCX H; MOV C,M                        */ \
    CHAIN2(2B, 56)        /* DCX H; MOV D,M                        */ \
    CHAIN2(2B, 5E)        /* DCX H; MOV E,M                        */ \
    CHAIN2(2B, 77)        /* DCX H; MOV M,A                        */ \
    CHAIN2(2B, 7C)        /* DCX H; MOV A,H                        */ \
    CHAIN2(2D, C2)        /* DCR L; JNZ                            */ \
    CHAIN2(3D, C2)        /* DCR A; JNZ                            */ \
    CHAIN3(3E, CE, 57)    /* MVI A; ACI; MOV D,A                */ \
    CHAIN2(42, 4B)        /* MOV B,D; MOV C,E                      */ \
    CHAIN2(44, 4D)        /* MOV B,H; MOV C,L                      */ \
    CHAIN2(46, 23)        /* MOV B,M; INX H                        */ \
    CHAIN2(4E, 23)        /* MOV C,M; INX H                        */ \
    CHAIN2(4F, 6F)        /* MOV C,A; MOV L,A                   */ \
    CHAIN2(50, 59)        /* MOV D,B; MOV E,C                      */ \
    CHAIN2(54, 5D)        /* MOV D,H; MOV E,L                      */ \
    CHAIN2(56, 23)        /* MOV D,M; INX H                        */ \
    CHAIN2(56, D5)        /* MOV D,M; PUSH D                    */ \
    CHAIN3(57, 7D, 87)    /* MOV D,A; MOV A,L; ADD A            */ \
    CHAIN2(5E, 23)        /* MOV E,M; INX H                        */ \
    CHAIN3(5F, 87, 87)    /* MOV E,A; ADD A; ADD A              */ \
    CHAIN2(5F, 54)        /* MOV E,A; MOV D,H                   */ \
    CHAIN2(60, 69)        /* MOV H,B; MOV L,C                      */ \
    CHAIN2(62, 6B)        /* MOV H,D; MOV L,E                      */ \
    CHAIN3(6F, E6, 5F)    /* MOV L,A; ANI; MOV E,A              */ \
    CHAIN2(6F, 26)        /* MOV L,A; MVI H                     */ \
    CHAIN2(70, 23)        /* MOV M,B; INX H                        */ \
    CHAIN2(71, 23)        /* MOV M,C; INX H                        */ \
    CHAIN2(72, 23)        /* MOV M,D; INX H                        */ \
    CHAIN2(73, 23)        /* MOV M,E; INX H                        */ \
    CHAIN2(77, 23)        /* MOV M,A; INX H                        */ \
    CHAIN2(77, 13)        /* MOV M,A; INX D                        */ \
    CHAIN3(78, B1, C2)    /* MOV A,B; ORA C; JNZ                   */ \
    CHAIN3(78, B1, CA)    /* MOV A,B; ORA C; JZ                    */ \
    CHAIN3(78, 1F, 47)    /* MOV A,B; RAR; MOV B,A                 */ \
    CHAIN3(78, 17, 47)    /* MOV A,B; RAL; MOV B,A                 */ \
    CHAIN3(78, 0F, 47)    /* MOV A,B; RRC; MOV B,A                 */ \
    CHAIN3(78, 07, 47)    /* MOV A,B; RLC; MOV B,A                 */ \
    CHAIN3(78, 82, 47)    /* MOV A,B; ADD D; MOV B,A               */ \
    CHAIN3(78, 84, 47)    /* MOV A,B; ADD H; MOV B,A               */ \
    CHAIN3(78, 8A, 47)    /* MOV A,B; ADC D; MOV B,A               */ \
    CHAIN3(78, 8C, 47)    /* MOV A,B; ADC H; MOV B,A               */ \
    CHAIN3(78, 92, 47)    /* MOV A,B; SUB D; MOV B,A               */ \
    CHAIN3(78, 94, 47)    /* MOV A,B; SUB H; MOV B,A               */ \
    CHAIN3(78, 9A, 47)    /* MOV A,B; SBB D; MOV B,A               */ \
    CHAIN3(78, 9C, 47)    /* MOV A,B; SBB H; MOV B,A               */ \
    CHAIN3(79, 1F, 4F)    /* MOV A,C; RAR; MOV C,A                 */ \
    CHAIN3(79, 17, 4F)    /* MOV A,C; RAL; MOV C,A                 */ \
    CHAIN3(79, 0F, 4F)    /* MOV A,C; RRC; MOV C,A                 */ \
    CHAIN3(79, 07, 4F)    /* MOV A,C; RLC; MOV C,A                 */ \
    CHAIN3(79, 83, 4F)    /* MOV A,C; ADD E; MOV C,A               */ \
    CHAIN3(79, 85, 4F)    /* MOV A,C; ADD L; MOV C,A               */ \
    CHAIN3(79, 8B, 4F)    /* MOV A,C; ADC E; MOV C,A               */ \
    CHAIN3(79, 8D, 4F)    /* MOV A,C; ADC L; MOV C,A               */ \
    CHAIN3(79, 93, 4F)    /* MOV A,C; SUB E; MOV C,A               */ \
    CHAIN3(79, 95, 4F)    /* MOV A,C; SUB L; MOV C,A               */ \
    CHAIN3(79, 9B, 4F)    /* MOV A,C; SBB E; MOV C,A               */ \
    CHAIN3(79, 9D, 4F)    /* MOV A,C; SBB L; MOV C,A               */ \
    CHAIN2(79, FE)        /* MOV A,C; CPI                       */ \
    CHAIN3(7A, B3, C2)    /* MOV A,D; ORA E; JNZ                   */ \
    CHAIN3(7A, B3, CA)    /* MOV A,D; ORA E; JZ                    */ \
    CHAIN3(7A, 1F, 57)    /* MOV A,D; RAR; MOV D,A                 */ \
    CHAIN3(7A, 17, 57)    /* MOV A,D; RAL; MOV D,A                 */ \
    CHAIN3(7A, 0F, 57)    /* MOV A,D; RRC; MOV D,A                 */ \
    CHAIN3(7A, 07, 57)    /* MOV A,D; RLC; MOV D,A                 */ \
    CHAIN3(7A, 84, 57)    /* MOV A,D; ADD H; MOV D,A               */ \
    CHAIN3(7A, 80, 57)    /* MOV A,D; ADD B; MOV D,A               */ \
    CHAIN3(7A, 8C, 57)    /* MOV A,D; ADC H; MOV D,A               */ \
    CHAIN3(7A, 88, 57)    /* MOV A,D; ADC B; MOV D,A               */ \
    CHAIN3(7A, 94, 57)    /* MOV A,D; SUB H; MOV D,A               */ \
    CHAIN3(7A, 90, 57)    /* MOV A,D; SUB B; MOV D,A               */ \
    CHAIN3(7A, 9C, 57)    /* MOV A,D; SBB H; MOV D,A               */ \
    CHAIN3(7A, 98, 57)    /* MOV A,D; SBB B; MOV D,A               */ \
    CHAIN3(7B, 1F, 5F)    /* MOV A,E; RAR; MOV E,A                 */ \
    CHAIN3(7B, 17, 5F)    /* MOV A,E; RAL; MOV E,A                 */ \
    CHAIN3(7B, 0F, 5F)    /* MOV A,E; RRC; MOV E,A                 */ \
    CHAIN3(7B, 07, 5F)    /* MOV A,E; RLC; MOV E,A                 */ \
    CHAIN3(7B, 85, 5F)    /* MOV A,E; ADD L; MOV E,A               */ \
    CHAIN3(7B, 81, 5F)    /* MOV A,E; ADD C; MOV E,A               */ \
    CHAIN3(7B, 8D, 5F)    /* MOV A,E; ADC L; MOV E,A               */ \
    CHAIN3(7B, 89, 5F)    /* MOV A,E; ADC C; MOV E,A               */ \
    CHAIN3(7B, 95, 5F)    /* MOV A,E; SUB L; MOV E,A               */ \
    CHAIN3(7B, 91, 5F)    /* MOV A,E; SUB C; MOV E,A               */ \
    CHAIN3(7B, 9D, 5F)    /* MOV A,E; SBB L; MOV E,A               */ \
    CHAIN3(7B, 99, 5F)    /* MOV A,E; SBB C; MOV E,A               */ \
    CHAIN3(7C, B5, C2)    /* MOV A,H; ORA L; JNZ                   */ \
    CHAIN3(7C, B5, CA)    /* MOV A,H; ORA L; JZ                    */ \
    CHAIN3(7C, 1F, 67)    /* MOV A,H; RAR; MOV H,A                 */ \
    CHAIN3(7C, 17, 67)    /* MOV A,H; RAL; MOV H,A                 */ \
    CHAIN3(7C, 0F, 67)    /* MOV A,H; RRC; MOV H,A                 */ \
    CHAIN3(7C, 07, 67)    /* MOV A,H; RLC; MOV H,A                 */ \
    CHAIN3(7C, 82, 67)    /* MOV A,H; ADD D; MOV H,A               */ \
    CHAIN3(7C, 80, 67)    /* MOV A,H; ADD B; MOV H,A               */ \
    CHAIN3(7C, 8A, 67)    /* MOV A,H; ADC D; MOV H,A               */ \
    CHAIN3(7C, 88, 67)    /* MOV A,H; ADC B; MOV H,A               */ \
    CHAIN3(7C, 92, 67)    /* MOV A,H; SUB D; MOV H,A               */ \
    CHAIN3(7C, 90, 67)    /* MOV A,H; SUB B; MOV H,A               */ \
    CHAIN3(7C, 9A, 67)    /* MOV A,H; SBB D; MOV H,A               */ \
    CHAIN3(7C, 98, 67)    /* MOV A,H; SBB B; MOV H,A               */ \
    CHAIN3(7D, 1F, 6F)    /* MOV A,L; RAR; MOV L,A                 */ \
    CHAIN3(7D, 17, 6F)    /* MOV A,L; RAL; MOV L,A                 */ \
    CHAIN3(7D, 0F, 6F)    /* MOV A,L; RRC; MOV L,A                 */ \
    CHAIN3(7D, 07, 6F)    /* MOV A,L; RLC; MOV L,A                 */ \
    CHAIN3(7D, 83, 6F)    /* MOV A,L; ADD E; MOV L,A               */ \
    CHAIN3(7D, 81, 6F)    /* MOV A,L; ADD C; MOV L,A               */ \
    CHAIN3(7D, 8B, 6F)    /* MOV A,L; ADC E; MOV L,A               */ \
    CHAIN3(7D, 89, 6F)    /* MOV A,L; ADC C; MOV L,A               */ \
    CHAIN3(7D, 93, 6F)    /* MOV A,L; SUB E; MOV L,A               */ \
    CHAIN3(7D, 91, 6F)    /* MOV A,L; SUB C; MOV L,A               */ \
    CHAIN3(7D, 9B, 6F)    /* MOV A,L; SBB E; MOV L,A               */ \
    CHAIN3(7D, 99, 6F)    /* MOV A,L; SBB C; MOV L,A               */ \
    CHAIN2(7D, 87)        /* MOV A,L; ADD A                     */ \
    CHAIN3(7E, 1F, 77)    /* MOV A,M; RAR; MOV M,A                 */ \
    CHAIN3(7E, 17, 77)    /* MOV A,M; RAL; MOV M,A                 */ \
    CHAIN3(7E, FE, CA)    /* MOV A,M; CPI; JZ                   */ \
    CHAIN2(7E, 23)        /* MOV A,M; INX H                        */ \
    CHAIN2(7E, B7)        /* MOV A,M; ORA A                        */ \
    CHAIN2(7E, 12)        /* MOV A,M; STAX D                       */ \
    CHAIN2(7E, FE)        /* MOV A,M; CPI                       */ \
    CHAIN2(86, 77)        /* ADD M; MOV M,A                        */ \
    CHAIN3(87, 83, 5F)    /* ADD A; ADD E; MOV E,A              */ \
    CHAIN2(87, D2)        /* ADD A; JNC                         */ \
    CHAIN2(8E, 27)        /* ADC M; DAA                            */ \
    CHAIN2(8E, 77)        /* ADC M; MOV M,A                        */ \
    CHAIN2(9E, 77)        /* SBB M; MOV M,A                        */ \
    CHAIN2(A7, CA)        /* ANA A; JZ                             */ \
    CHAIN2(A7, C2)        /* ANA A; JNZ                            */ \
    CHAIN2(A7, C8)        /* ANA A; RZ                             */ \
    CHAIN2(A7, C0)        /* ANA A; RNZ                            */ \
    CHAIN2(AE, 77)        /* XRA M; MOV M,A                        */ \
    CHAIN2(B7, CA)        /* ORA A; JZ                             */ \
    CHAIN2(B7, C2)        /* ORA A; JNZ                            */ \
    CHAIN2(B7, C8)        /* ORA A; RZ                             */ \
    CHAIN2(B7, C0)        /* ORA A; RNZ                            */ \
    CHAIN2(B7, FA)        /* ORA A; JM                             */ \
    CHAIN2(B7, F2)        /* ORA A; JP                             */ \
    CHAIN2(B7, F8)        /* ORA A; RM                             */ \
    CHAIN2(B7, F0)        /* ORA A; RP                             */ \
    CHAIN2(BE, CA)        /* CMP M; JZ                             */ \
    CHAIN2(BE, C2)        /* CMP M; JNZ                            */ \
    CHAIN2(BE, C8)        /* CMP M; RZ                             */ \
    CHAIN2(BE, C0)        /* CMP M; RNZ                            */ \
    CHAIN2(BE, DA)        /* CMP M; JC                             */ \
    CHAIN2(BE, D2)        /* CMP M; JNC                            */ \
    CHAIN3(C1, D1, E1)    /* POP B; POP D; POP H                   */ \
    CHAIN2(C1, C9)        /* POP B; RET                            */ \
    CHAIN2(C1, D1)        /* POP B; POP D                          */ \
    CHAIN2(C1, E1)        /* POP B; POP H                          */ \
    CHAIN2(C1, F1)        /* POP B; POP PSW                        */ \
    CHAIN2(C1, 0A)        /* POP B; LDAX B                      */ \
    CHAIN3(C5, D5, E5)    /* PUSH B; PUSH D; PUSH H                */ \
    CHAIN3(C5, B7, C8)    /* PUSH B; ORA A; RZ                  */ \
    CHAIN2(C5, D5)        /* PUSH B; PUSH D                        */ \
    CHAIN2(C5, E5)        /* PUSH B; PUSH H                        */ \
    CHAIN2(C5, F5)        /* PUSH B; PUSH PSW                      */ \
    CHAIN2(C6, 4F)        /* ADI; MOV C,A                       */ \
    CHAIN2(D1, C9)        /* POP D; RET                            */ \
    CHAIN2(D1, C1)        /* POP D; POP B                          */ \
    CHAIN2(D1, E1)        /* POP D; POP H                          */ \
    CHAIN2(D1, F1)        /* POP D; POP PSW                        */ \
    CHAIN2(D5, C5)        /* PUSH D; PUSH B                        */ \
    CHAIN2(D5, E5)        /* PUSH D; PUSH H                        */ \
    CHAIN2(D5, F5)        /* PUSH D; PUSH PSW                      */ \
    CHAIN2(D5, FE)        /* PUSH D; CPI                        */ \
    CHAIN2(D6, 5F)        /* SUI; MOV E,A                       */ \
    CHAIN3(E1, D1, C1)    /* POP H; POP D; POP B                   */ \
    CHAIN2(E1, C9)        /* POP H; RET                            */ \
    CHAIN2(E1, C1)        /* POP H; POP B                          */ \
    CHAIN2(E1, D1)        /* POP H; POP D                          */ \
    CHAIN2(E1, F1)        /* POP H; POP PSW                        */ \
    CHAIN3(E5, D5, C5)    /* PUSH H; PUSH D; PUSH B                */ \
    CHAIN2(E5, C5)        /* PUSH H; PUSH B                        */ \
    CHAIN2(E5, D5)        /* PUSH H; PUSH D                        */ \
    CHAIN2(E5, F5)        /* PUSH H; PUSH PSW                      */ \
    CHAIN2(E5, CD)        /* PUSH H; CALL                       */ \
    CHAIN2(E6, CA)        /* ANI; JZ                               */ \
    CHAIN2(E6, C2)        /* ANI; JNZ                              */ \
    CHAIN2(E6, C8)        /* ANI; RZ                               */ \
    CHAIN2(E6, C0)        /* ANI; RNZ                              */ \
    CHAIN3(EB, AE, EB)    /* XCHG; XRA M; XCHG                  */ \
    CHAIN2(EB, 29)        /* XCHG; DAD H                           */ \
    CHAIN2(EB, 87)        /* XCHG; ADD A                        */ \
    CHAIN2(F1, C9)        /* POP PSW; RET                          */ \
    CHAIN2(F1, C1)        /* POP PSW; POP B                        */ \
    CHAIN2(F1, D1)        /* POP PSW; POP D                        */ \
    CHAIN2(F1, E1)        /* POP PSW; POP H                        */ \
    CHAIN2(F5, C5)        /* PUSH PSW; PUSH B                      */ \
    CHAIN2(F5, D5)        /* PUSH PSW; PUSH D                      */ \
    CHAIN2(F5, E5)        /* PUSH PSW; PUSH H                      */ \
    CHAIN2(FE, CA)        /* CPI; JZ                               */ \
    CHAIN2(FE, C2)        /* CPI; JNZ                              */ \
    CHAIN2(FE, C8)        /* CPI; RZ                               */ \
    CHAIN2(FE, C0)        /* CPI; RNZ                              */ \
    CHAIN2(FE, DA)        /* CPI; JC                               */ \
    CHAIN2(FE, D2)        /* CPI; JNC                              */ \
    CHAIN2(FE, D8)        /* CPI; RC                            */
