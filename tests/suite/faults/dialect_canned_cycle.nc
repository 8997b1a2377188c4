; check: exit 1
; error 20131 at 5:1
; error 20131 at 8:1
; each number once
G81 X1 Y1 Z-2 R1 F100
X2 Y2
G81 X3
G80
M30
