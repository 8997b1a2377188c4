; check: exit 1
; error 20524 at 3:11
#CALL AX [K,1,3]
M30
