; check: exit 1
; error K-0013 at 3:3
L called/absent.nc
M30
