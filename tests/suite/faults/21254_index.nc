; check: exit 1
; error 21254 at 3:15
#CALL AX [X,1,9999]
M30
