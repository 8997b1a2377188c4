; run: exit 1
; error 21542 at 4:11
#FILE NAME [G80="called/empty.nc"]
G80 $GOTO N10
N10:
M30
