; check: exit 1
; error 120370 at 9:1
; error 120370 at 10:1
; error 120370 at 11:1
; error 120370 at 12:1
; error 120370 at 13:1
#HSC ON[BSPLINE]
G01 F1000 X10
G151 X20
X30 Y3
X40
X50 Y2
G150
#HSC OFF
M30
