; check: exit 1
; page 15556691083 dimensions for whole blocks, G90 beside G91
; error K-0008 at 5:14
N05 F6000
N110 G91 X10 G90 Z30
M30
