; check --external A=3: exit 1
; error 20651 at 6:4
#CONTOUR MODE [DEV PATH_DEV=0.1]
G01 F1000 X5 G61
G04 0.1
P1=V.E.A
Y5
M30
