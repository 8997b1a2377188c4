; check: exit 1
; page 251755403 diagnosis 20490, manual mode with increments, right
; error K-0019 at 4:27
N10 #SET TIP[1.0,1.5,2.0] X
M30
