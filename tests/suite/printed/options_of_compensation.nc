; check: exit 1
; page 1067243147 limit of tangential transitions (#TRC)
; error K-0019 at 4:11
N10 #TRC [TANGENTIAL_LIMIT=1.5]
N20 G01 X10 F1000
N30 M30
