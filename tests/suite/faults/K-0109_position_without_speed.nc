; check: exit 0
; warning K-0109 at 3:2
S[M19 POS=90]
M30
