; run: exit 0
; page 208164107 homing of axes and of a spindle (G74)
; end X0 Y0 Z0
; warning K-0111 at 5:5
N10 G74 X2 Y1 S1
N20 G74 S1
N30 G74 X1 Y2
N40 M30
