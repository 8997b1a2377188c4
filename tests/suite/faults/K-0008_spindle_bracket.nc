; check: exit 1
; error K-0008 at 3:6
S[M3 M4]
M30
