; check: exit 1
; error 21502 at called/open.nc 1:5
L called/open.nc
M30
