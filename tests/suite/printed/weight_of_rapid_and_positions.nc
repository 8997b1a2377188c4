; run: exit 0
; page 15556771979 weight of the rapid velocity with positions in its block (G129)
; end X10 Y20
N10 G129 = 70
N20 G00 X100 Y150
N50 G129 = 70 X10 Y20
M30
