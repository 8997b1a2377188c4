; check: exit 1
; error 21260 at 4:15
#PUT AX [Z]
#CALL AX [Z,3,0]
M30
