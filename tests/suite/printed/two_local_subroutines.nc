; run: exit 0
; page 15556849803 local subroutines, without their ends
; end X10 Y3
%L UP1
N1 G91 X5
N9 M17
%L UP2
N11 G91 Y3
%100
N100 G01 F1000
N200 LL UP1
N250 LL UP2
N260 LL UP1
N300 M30
