; check: exit 1
; error K-0002 at 3:15
N50 X[2*[P1+3]
M30
