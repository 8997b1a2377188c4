; check: exit 1
; error 20155 at 3:6
S[M3 M4 REV100]
M30
