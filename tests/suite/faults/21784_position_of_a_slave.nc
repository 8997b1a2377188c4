; check: exit 1
; error 21784 at 6:6
#SET AX [X, 1, 0][Y, 2, 1][C, 3, 3]
#SET AX LINK [1, C=Y]
#ENABLE AX LINK [1]
P1 = V.A.ACS.ABS.C
M30
