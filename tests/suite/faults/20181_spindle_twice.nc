; check: exit 1
; error 20181 at 3:21
S1000 M3 X100 F2000 S1500
M5
M30
