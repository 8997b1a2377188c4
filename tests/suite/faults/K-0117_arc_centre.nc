; check: exit 1
; error K-0117 at 3:9
G02 X10 I8 F1000
M30
