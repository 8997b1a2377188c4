; run -m two_spindles: exit 0
; page 286059787 spindle beside a motion
; end X100
N10 S2[M3 REV1000] G01 F100 X100
N20 M30
