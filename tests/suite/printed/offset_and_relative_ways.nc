; run: exit 0
; page 206145291 reference point offset, relative ways
; end X11 Y0
N10 G92 X10 Y20
N20 G00 X0 G91
N30 G90 X1
N40 M30
