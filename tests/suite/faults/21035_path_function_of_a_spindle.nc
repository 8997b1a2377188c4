; check: exit 1
; error 21035 at 3:13
S[M3 REV100 G01]
M30
