; check: exit 1
; page 15556691083 dimensions for whole blocks, G90 twice
; error K-0008 at 5:14
N05 F6000
N100 G90 Z30 G90
M30
