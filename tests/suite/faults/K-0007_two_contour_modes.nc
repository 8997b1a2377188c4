; check: exit 1
; error K-0007 at 3:20
#CONTOUR MODE [DEV DIST]
M30
