; run: exit 1
; error 20875 at 3:11
#FACE [X, J, Z]
M30
