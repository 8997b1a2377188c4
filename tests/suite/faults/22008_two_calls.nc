; check: exit 1
; error 22008 at 3:19
L called/empty.nc L called/empty.nc
M30
