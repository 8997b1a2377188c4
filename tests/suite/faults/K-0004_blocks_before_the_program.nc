; check: exit 1
; note K-0109 at 6:1
; error K-0004 at 9:1
; warning K-0003 at 5:1
G90
%L S
G01 X1 F1000
M17
%MAIN
LL S
G01 X5 F1000
M30
