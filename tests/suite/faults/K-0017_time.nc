; run --max-time 1: exit 1
; error K-0017 at 3:1
N10 G04 100
M30
