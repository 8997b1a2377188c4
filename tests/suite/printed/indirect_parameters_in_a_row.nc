; run: exit 0
; page 206884875 indirect parameters, a row of them
; end X7 Y0 Z7
P14=7 P26=7 P15=1 P25=2
N110 $FOR P1 = 10,20,1
N120 P[P1 + 5] = 0.0
N130 $ENDFOR
G01 F6000 XP14 Y[P15+P20+P25] ZP26
M30
