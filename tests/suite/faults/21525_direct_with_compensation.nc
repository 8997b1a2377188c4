; check: exit 1
; warning K-0114 at 4:1
; error 21525 at 5:1
G41 X100 F1000
#PTP ON
G40 X0
M30
