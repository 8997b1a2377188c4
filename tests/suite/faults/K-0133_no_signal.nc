; run: exit 1
; error K-0133 at 4:1
#MEAS MODE [2]
G100 X10
M30
