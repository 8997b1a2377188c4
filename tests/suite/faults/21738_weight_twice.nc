; check: exit 1
; error 21738 at 3:11
S[G136=50 G136=60]
M30
