; check: exit 1
; error 20977 at 4:9
F1000
N10 G09 G901 X5
M30
