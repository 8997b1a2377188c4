; check: exit 1
; error K-0010 at 3:9
G02 X10 R4 F1000
M30
