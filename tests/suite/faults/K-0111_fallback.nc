; check: exit 0
; warning K-0111 at 3:15
#HSC [BSPLINE MERGE=1]
M30
