; check: exit 1
; error K-0001 at 3:4
X1 ä F1000
M30
