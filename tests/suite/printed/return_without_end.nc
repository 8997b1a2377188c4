; run: exit 0
; page 206828043 local subroutine ended by the next program
; end X5 Y3
%L UP1
N1 G91 X5
%L UP2
N11 G91 Y3
%MAIN
N100 G01 F1000
N200 LL UP1
N250 LL UP2
N300 M30
