; check: exit 1
; error 20206 at 3:4
X1 $IF 1
M30
