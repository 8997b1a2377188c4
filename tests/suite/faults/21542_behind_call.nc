; check: exit 1
; error 21542 at 6:8
%L SUB
M17
%MAIN
LL SUB Z300
M30
