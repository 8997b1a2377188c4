; check: exit 1
; error 21382 at 3:2
X@P1 F1000
M30
