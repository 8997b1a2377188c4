; check: exit 0
; warning 50130 at 5:6
; warning 120037 at 5:6
; warning 120038 at 5:6
G132 X0.1
M30
