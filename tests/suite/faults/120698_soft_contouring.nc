; check: exit 1
; error 120698 at 7:1
#CONTOUR MODE [DEV PATH_DEV=0.2]
G261 F1000
X10 Y10
(the control refuses it here)
#CONTOUR MODE [DIST_SOFT]
X0 Y0
G260
M30
