; run: exit 0
; page 15556915851 decoding waits for the interpolation (#FLUSH WAIT)
; end X40
N05 F1000
N10 G01 X20
N20 #FLUSH WAIT
N30 X40
M30
