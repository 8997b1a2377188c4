; check: exit 1
; error 120566 at 6:1
; error 120566 at 7:1
#FGROUP [X,Y]
G261
G01 F1000 X5
Y5
G260
M30
