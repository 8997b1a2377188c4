; check: exit 1
; error 20931 at 3:9
#DELETE V.A.ABS.X
M30
