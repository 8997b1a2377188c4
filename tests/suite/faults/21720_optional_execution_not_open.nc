; check: exit 1
; error 21720 at 5:1
; warning K-0100 at 5:1
%L UP
#OPTIONAL EXECUTION OFF
M17
%MAIN
LL UP
M30
