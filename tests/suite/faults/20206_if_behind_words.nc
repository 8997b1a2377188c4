; check: exit 1
; error 20206 at 3:10
X1 F1000 $IF 1
M30
