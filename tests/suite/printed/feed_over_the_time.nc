; run: exit 0
; page 15556679307 feed interpolation over the time (G293)
; end X100
#SLOPE [TYPE=STEP]
N10 G01 X50 F1000
N20 G293 X90 F400
N30 X100 F400
N40 M30
