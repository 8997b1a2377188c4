; run: exit 0
; end X0 Y0 Z6
(words of the block first; M17 may be missing)
%L UP
G91 Z1 F100
G90
%MAIN
Z5 F100 LL UP
M30
