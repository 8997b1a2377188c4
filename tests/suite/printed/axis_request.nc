; run: exit 0
; page 207015051 requests of axes
; end X1 Y2 Z3
N10 #AX REQUEST [Z,3,2]
N20 G00 X1 Y2 Z3
N30 M30
