; run: exit 1
; error 22008 at 4:1
#FILE NAME [G80="called/empty.nc"]
G80 L called/empty.nc
M30
