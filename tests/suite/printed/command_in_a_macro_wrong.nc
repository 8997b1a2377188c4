; check: exit 1
; page 252099211 diagnosis 20644, wrong
; error 20644 at 6:5
%dummy
N10 "MACRO"="#FLUSH WAIT"
N20 "MACRO" G01 X10 F1000
N30 M30
