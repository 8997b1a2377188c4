; check --set X.kenngr.swe_neg=-5000000: exit 1
; error 21878 at 3:9
N10 G99 X-600
M30
