; check: exit 1
; error 20038 at 3:5
N10 G201
M30
