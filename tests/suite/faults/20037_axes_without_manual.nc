; check: exit 1
; error 20037 at 3:5
N10 #ACHSE[X]
M30
