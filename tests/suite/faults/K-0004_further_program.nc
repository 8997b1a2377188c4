; check: exit 0
; note K-0004 at 6:1
%A
F600 G01 X1
M30
%B
X5
M30
