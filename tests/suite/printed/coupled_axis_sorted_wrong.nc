; check: exit 1
; page 254170763 diagnosis 21312, wrong
; error 21312 at 8:5
#SET AX [X,1,0][Y,2,1][C,3,3]
N10 G00 X0 Y0
N30 #SET AX LINK[1, C=Y]
N40 #ENABLE AX LINK[1]
N50 #SET AX [X,1,0] [Y,2,1] [C,3,2]
N1000 M30
