; check: exit 1
; error 21220 at 3:16
#CONTOUR MODE [0.1]
M30
