; run: exit 0
; page 252099211 diagnosis 20644, right
; end X10
%dummy
N10 "MACRO"="#FLUSH WAIT"
N20 "MACRO"
N30 G01 X10 F1000
N40 M30
