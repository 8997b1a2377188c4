; check: exit 1
; error 20014 at 3:5
G04 Y2
M30
