; check: exit 0
; warning 20193 at 4:1
N10 X1 F1000
% text
N20 M30
