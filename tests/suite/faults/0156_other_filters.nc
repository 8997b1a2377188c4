; check --set X,Y.vib_guard.freq=40 --set Z.vib_guard.freq=10: exit 0
; warning K-0112 at 7:1
; warning K-0156 at 7:1
#SET AX [X,1,0][Y,2,1][C,3,3]
#SET AX LINK [1, C=X]
#ENABLE AX LINK [1]
#VIB GUARD ON [AX_DEV=0.01]
G01 X20 F3000
M30
