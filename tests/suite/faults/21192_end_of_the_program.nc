; check: exit 1
; error 21192 at 4:3
; error 21192 at 5:13
X[M30]
S[M3 REV100 M17]
M30
