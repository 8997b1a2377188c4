; check: exit 1
; error 20194 at 5:15
; error 20131 at 5:1
; each word once
G82 X1 Z-2 R1 P500 F100
G82 X2 P500
M30
