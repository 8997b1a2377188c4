; check: exit 1
; error 20360 at called/calls_itself.nc 1:3
L called/calls_itself.nc
M30
