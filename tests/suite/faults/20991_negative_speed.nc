; check: exit 1
; error 20991 at 3:6
S[M3 REV=-100]
M30
