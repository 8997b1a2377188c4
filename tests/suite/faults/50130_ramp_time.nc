; check: exit 0
; warning 50130 at 5:1
; warning 120037 at 5:1
; warning 120038 at 5:1
G133=1
M30
