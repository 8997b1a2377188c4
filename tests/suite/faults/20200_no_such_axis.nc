; check: exit 1
; error 20200 at 3:1
Q10 F1000
M30
