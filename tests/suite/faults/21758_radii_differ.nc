; check: exit 1
; error 21758 at 4:12
G164 F1000
G02 X10 Y0 I5.5 J0
M30
