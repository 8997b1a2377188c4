; check: exit 1
; error 20112 at 3:5
G22 G23
M30
