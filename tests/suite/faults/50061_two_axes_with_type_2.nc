; check: exit 1
; error 50061 at 4:10
#MEAS MODE [2]
G100 X10 Y10
M30
