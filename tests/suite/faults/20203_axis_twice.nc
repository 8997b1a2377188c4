; check: exit 1
; error 20203 at 3:9
X10 Y20 X10 F1000
M30
