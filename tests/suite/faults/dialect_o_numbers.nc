; check: exit 1
; error 20192 at 4:1
; program numbers of other dialects
O1000
X1 F100
O1001
M30
