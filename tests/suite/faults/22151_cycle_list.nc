; check: exit 1
; error 22151 at 4:9
#FILE NAME [G80="called/empty.nc"]
G80 [12 =]
M30
