; check: exit 1
; error 20797 at 3:10
#PUT AX [1]
M30
