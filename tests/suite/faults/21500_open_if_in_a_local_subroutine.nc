; check: exit 1
; error 21500 at 4:1
%L SUB
$IF 0
M17
%MAIN
LL SUB
M30
