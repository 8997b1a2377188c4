; run --max-time 0.286: exit 1
; error K-0017 at 3:1
N10 G04 X0.287
M30
