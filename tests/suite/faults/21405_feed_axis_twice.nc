; check: exit 1
; error 21405 at 3:1
#FGROUP [X,X]
G01 X10 F1000
M30
