; check: exit 1
; error 20175 at 3:9
X1 F100 F200
M30
