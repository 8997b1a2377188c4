; check: exit 1
; error 20921 at 3:1
P5[1]=2
M30
