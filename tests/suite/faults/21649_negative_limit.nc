; check --set X.kenngr.swe_pos=5000000: exit 1
; error 21649 at 3:9
N10 G98 X600
M30
