; check: exit 0
; note K-0004 at 6:1
N10 G01 X1 F1000
N20 M30 (the end)
; a remark
N30 X100
N40 X200
