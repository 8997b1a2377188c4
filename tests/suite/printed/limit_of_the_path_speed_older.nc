; run: exit 0
; page 15427960971 limit of the path speed in its older form (#VECTORVEL)
; end X10 Y10 Z10
N10 #VECTORVEL[5000] ON
N20 G01 X10 Y10 Z10 F10000
N1000 #VECTORVEL OFF
M30
