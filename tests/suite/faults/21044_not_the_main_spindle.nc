; check -m two_spindles: exit 1
; error 21044 at 3:1
S2=100
M30
