; check: exit 1
; error 21387 at 3:1
#IF 1
X100 F1000
M30
