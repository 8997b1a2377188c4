; check: exit 1
; error K-0019 at 5:5
; warning K-0118 at 6:8
%L SUB
M17 [MAIN [AFTER]]
N10 m29[JUMPS=2 N100]
%MAIN
LL SUB
[AFTER] M30
