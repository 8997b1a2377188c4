; check --set channel.tool.minimum_length=500000 --set tool.wz[1].gueltig=1 --set tool.wz[1].laenge=499999: exit 1
; error 21426 at 3:1
D1
M30
