; check: exit 1
; error K-0120 at 3:1
DEF REAL DEPTH=5
X=DEPTH F100
M30
