; check: exit 0
; warning K-0020 at 3:6
G136 X120
M30
