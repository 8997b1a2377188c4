; check: exit 0
; warning 21313 at called/percent.nc 2:1
L called/percent.nc
M30
