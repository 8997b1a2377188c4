; check: exit 1
; error 20100 at 3:1
V.A.MENT.X=1
M30
