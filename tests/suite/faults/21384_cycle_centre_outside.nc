; check: exit 1
; error 21384 at 3:5
G01 @I=100 X200 F500
M30
