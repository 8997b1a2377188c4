; check: exit 1
; error 22008 at 4:4
#FILE NAME [M6="called/plain.nc" D="called/plain.nc"]
D0 M6
M30
