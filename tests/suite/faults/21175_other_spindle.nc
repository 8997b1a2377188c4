; check -m two_spindles: exit 1
; error 21175 at 3:7
#CAX [S2, C]
M30
