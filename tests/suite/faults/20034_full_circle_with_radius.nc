; check: exit 1
; error 20034 at 3:11
G02 X0 Y0 R10 F1000
M30
