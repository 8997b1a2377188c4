; check: exit 1
; page 250523787 diagnosis 20011, wrong
; error 20011 at 5:5
N10   G00 X0 Y0 Z0
N20 X94967596
N1000 M30
