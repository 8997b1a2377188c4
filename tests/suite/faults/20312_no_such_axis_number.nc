; check: exit 1
; error 20312 at 3:13
#CALL AX [W,99,3]
M30
