; run: exit 0
; page 207084683 type of measuring runs (#MEAS MODE)
; note K-0133 at 5:5
N10 #MEAS MODE[3]
N20 G100 X150 F1000
N100 #MEAS MODE
M30
