; check: exit 1
; error 22008 at 4:9
#FILE NAME [G80="called/cycle.nc" G81="called/cycle.nc"]
G80 [1] G81 [1]
M30
