; check: exit 1
; page 251981707 diagnosis 20612, wrong
; warning K-0101 at 7:5
; error 20612 at 8:5
; warning K-0101 at 9:6
N10 G00 X0 Y0 Z0
N20 G21
N50 #PSET X200
N100 G20
N110 M30
