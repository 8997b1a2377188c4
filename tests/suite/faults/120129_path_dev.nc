; check: exit 1
; error 120129 at 3:23
#CONTOUR MODE ON [DEV PATH_DEV=0]
M30
