; check: exit 0
; warning K-0109 at 3:4
X1 I5 F1000
M30
