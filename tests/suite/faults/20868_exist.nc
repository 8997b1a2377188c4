; check: exit 1
; error 20868 at 3:10
P1=EXIST[5]
M30
