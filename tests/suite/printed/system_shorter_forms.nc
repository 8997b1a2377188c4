; run: exit 0
; page 208480907 coordinate systems, shortened
; end X1 Y2 Z13
#CS DEF [2][0,0,10]
#CS ON [2]
N10 G01 X1 Y2 Z3 F1000
#CS OFF
N20 M30
