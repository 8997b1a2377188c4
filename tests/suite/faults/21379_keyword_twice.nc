; check: exit 1
; error 21379 at 3:37
L CYCLE [NAME=called/cycle.nc @P1=1 @P1=2]
M30
