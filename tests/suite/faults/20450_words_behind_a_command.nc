; check: exit 1
; error 20450 at 3:20
#SLOPE [TYPE=STEP] X10
M30
