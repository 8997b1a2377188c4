; check: exit 1
; error 120131 at 3:24
#CONTOUR MODE ON [DIST PRE_DIST=0]
M30
