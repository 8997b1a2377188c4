; check: exit 1
; error K-0151 at 5:1
G01 X10 F1000
G151
X20 Y5
G150
M30
