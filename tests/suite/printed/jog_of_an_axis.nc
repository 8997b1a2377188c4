; run: exit 0
; page 251755403 diagnosis 20490, manual mode with increments, right
; end X0
; warning K-0100 at 5:5
N10 #SET TIP[1.0,1.5,2.0] X
M30
