; check -m gantry: exit 1
; error 21498 at 3:1
#CONTOUR MODE [DIST_SOFT]
M30
