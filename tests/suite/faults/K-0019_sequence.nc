; check: exit 1
; error K-0019 at 3:1
L SEQUENCE [NAME=a N10 N20]
M30
