; check: exit 1
; error 120255 at 9:1
; error 120255 at 10:1
; error 120255 at 11:1
; error 120255 at 12:1
G01 F1000 X0
G151
G261
X10 Y5
X20
X30 Y4
X40
G150
G260
M30
