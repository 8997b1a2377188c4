; check: exit 1
; page 250902411 diagnosis 20137, wrong
; error 20137 at 8:5
N05 #SET AX [X, 1, 0][Y, 2, 1][C, 3, 3]
N10 G00 X0 Y0
N30 #SET AX LINK [1, C=Y]
N40 #ENABLE AX LINK [1]
N50 G74 X1
N1000 M30
