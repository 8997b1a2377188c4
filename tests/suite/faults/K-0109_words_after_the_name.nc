; run: exit 0
; warning K-0109 at 3:7
%MAIN X1 F1000
Y2 F1000
M30
