; check: exit 1
; error K-0108 at 3:8
S[G135 M3]
M30
