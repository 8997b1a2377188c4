; run: exit 0
; page 251981707 diagnosis 20612, right
; warning K-0101 at 7:5
; warning K-0101 at 8:5
; end X10
N10 G00 X0 Y0 Z0
N20 G21
N30 G20
N40 #PSET X200
N50 G01 X210 F1000
N60 M30
