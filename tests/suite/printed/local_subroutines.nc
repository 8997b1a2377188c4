; run: exit 0
; page 206828043 local subroutines
; end X11 Y5
%L UP1 (the first one)
N10 G01 G91 X10 F2000
N20 M17
%L UP2 (the second one, without its end)
N30 G01 G91 Y5 F2000
%MAIN
N40 G00 G90 X1
N50 LL UP1
N60 G90
N70 LL UP2
N80 M30
