; run: exit 0
; page 15556648587 reference point offset (G92) and a relative way of 0
; end X0 Y0
N10 G92 X10 Y20
N20 G00 X0 G91
N30 M30
