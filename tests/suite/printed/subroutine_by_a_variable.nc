; run --external SUB=POCKET: exit 0
; page 206841355 call by a variable
; end X12
%L POCKET
N10 G01 X12 F2000
N20 M17
%MAIN
N30 LL V.E.SUB
N40 M30
