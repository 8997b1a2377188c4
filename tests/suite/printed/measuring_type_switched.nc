; check: exit 0
; page 207084683 type of measuring runs (#MEAS MODE)
N10 #MEAS MODE[3]
N20 G100 X150 F1000
N100 #MEAS MODE
M30
