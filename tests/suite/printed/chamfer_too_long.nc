; check: exit 1
; page 206615051 chamfer longer than a block (G301), third example
; error K-0009 at 7:5
N05 G00 X0 Y0
N10 G01 X20 Y-10 F100
N20 X20
N30 G301 I30
N40 X60 Y50
M30
