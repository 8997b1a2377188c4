; check: exit 1
; error 20521 at 3:17
#CALL AX [W,1,3,FOO]
M30
