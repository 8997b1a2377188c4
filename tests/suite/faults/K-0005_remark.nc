; check: exit 0
; warning K-0005 at 4:1
N10 X1 F1000
% text
N20 M30
