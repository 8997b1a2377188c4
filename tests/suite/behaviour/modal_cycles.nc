; run: exit 0
; end X3 Y1 Z11
; note K-0081 at 31:1
%L COUNT
G91 G01 Z1
G90
M17
%L OTHER
G91 G01 Y1
G90
M17
%MAIN
; A modal cycle runs at its call and again after each further motion, or after each further block: not after its own blocks,
; blank lines, remarks, control statements, calls, and the end of a program. Z counts the runs, Y those of the other subroutine.
N10 G90 F6000
N20 LL CYCLE [NAME=COUNT MODAL_MOVE]
N30 X1
P1=5
M8
#DISABLE MODAL CYCLE
N40 X2
; Z2
N50 LL CYCLE [NAME=COUNT MODAL_BLOCK]
N60 X3
N70 P1=6

(a remark)
$IF P1 == 6
N80 M8
$ENDIF
#MSG ["six"]
; Z7: the call, N60, N70, N80, #MSG
N90 LL OTHER
; Z9: the two blocks of OTHER before its end
N100 #DISABLE MODAL CYCLE
N110 LL CYCLE [NAME=COUNT MODAL_MOVE]
N120 #DISABLE MODAL CYCLE
N130 LL CYCLE [NAME=COUNT]
M30
