; check: exit 1
; error K-0009 at 4:24
N10 P1=1
L SEQUENCE [N10 REPEAT=0]
M30
