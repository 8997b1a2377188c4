; check: exit 1
; error 21261 at 4:11
#PUT AX [Z]
#CALL AX [X,3,2]
M30
