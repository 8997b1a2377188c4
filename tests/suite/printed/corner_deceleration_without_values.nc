; check: exit 1
; page 252569227 diagnosis 20795, G13 without its values
; error 20795 at 4:5
N20 G13
N30 G01 X10 F1000
N40 M30
