; check: exit 1
; error 20978 at 3:6
P1 = 99999999999 & 1
M30
