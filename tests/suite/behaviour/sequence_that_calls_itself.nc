; check: exit 1
; error 20360 at 3:16
N10 L SEQUENCE [N10]
M30
