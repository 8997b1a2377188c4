; check: exit 1
; error K-0011 at 3:9
P1=SQRT[-1]
M30
