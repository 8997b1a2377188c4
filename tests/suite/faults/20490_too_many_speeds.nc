; check: exit 1
; error 20490 at 3:26
N10 #SET TIP[1.0,1.5,2.0,5.0,10.0] X
M30
