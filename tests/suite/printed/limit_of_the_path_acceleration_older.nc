; run: exit 0
; page 15427960971 limit of the path acceleration in its older form (#VECTORACC)
; end X10 Y10 Z10
N10 #VECTORACC ON[2700000]
N20 G01 X10 Y10 Z10 F10000
N1000 #VECTORACC OFF
M30
