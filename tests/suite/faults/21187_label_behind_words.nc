; check: exit 1
; error 21187 at 3:10
N10 X100 [NAME] Y200 F1000
M30
