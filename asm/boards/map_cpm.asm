; map_cpm.asm - where things lie: a program of CP/M, from 0100H up
; Offers: names for all
;
; Page 0 is CP/M's: its warm boot's jump at 0, the drive at 4, the BDOS's jump at 5, the text
; of the command line at 80H.

CPWBT   EQU 0001H       ; -> the BIOS's entry for a warm boot
CPDRV   EQU 0004H       ; the present drive, low half
CPBDOS  EQU 0005H       ; the BDOS; the address of the jump there ends the memory
CPTAIL  EQU 0080H       ; length and text of the command line

; Cells that CP/M alone needs
;! ZBEND <= CPRAM and CPEND <= RAM -- program, these cells, the others
;! KEYQ & 0FFH == 0 -- KQPUT and KQGET are low bytes
;! KQGET == KQPUT+1 -- POLL takes both at once
CPRAM   EQU 2900H
KEYQ    EQU CPRAM       ; keys typed ahead, 32 bytes
RBUF    EQU CPRAM+32    ; record of the file that LOAD reads, 128 bytes
WBUF    EQU CPRAM+160   ; record of the file that is written; entries of the directory
FNAME   EQU CPRAM+288   ; name that a statement gives: drive, 8, 3 characters
PNAME   EQU CPRAM+300   ; name that PUNCH has given
WNAME   EQU CPRAM+312   ; name that the file which is written shall have
RFCB    EQU CPRAM+324   ; the BDOS's block for the file that LOAD reads, 36 bytes
WFCB    EQU CPRAM+360   ; for the one that is written; with another behind it, to rename it
WFCB2   EQU WFCB+16     ; that one
WBVEC   EQU CPRAM+412   ; -> the BIOS's entry for a warm boot, as CP/M had it
SCRP    EQU CPRAM+414   ; -> next character of the script
CPZERO  EQU CPRAM+416   ; from here on: 0 at the start
KQPUT   EQU CPZERO      ; where in KEYQ the next key goes
KQGET   EQU CPZERO+1    ; where the oldest one stands; the same place: there is none
RPOS    EQU CPZERO+2    ; next character in RBUF
WPOS    EQU CPZERO+3    ; next place in WBUF
FILEF   EQU CPZERO+4    ; not 0: LOAD's lines come from a file, not from the script
WMODE   EQU CPZERO+5    ; 0: no file is written; else WTAPE, WSAVE, WLOST
PUNF    EQU CPZERO+6    ; not 0: PUNCH has given a name
BATCH   EQU CPZERO+7    ; not 0: back to CP/M when the run is over
GAVEUP  EQU CPZERO+8    ; not 0: the BDOS has given up an error on a disk since it last looked at the disks anew
CPZEND  EQU CPZERO+9
SCRIPT  EQU CPZEND      ; lines that the command line asks for: 127 bytes of it, and what stands around
CPEND   EQU SCRIPT+168

RAM     EQU 2C00H       ; RAM, from a page's start
BDSTK   EQU 100H        ; bytes of the stack that what is called outside the firmware may take

        DS      0100H
ORIGIN:
