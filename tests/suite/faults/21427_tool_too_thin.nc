; check --set channel.tool.minimum_radius=20000 --set tool.wz[1].gueltig=1 --set tool.wz[1].radius=19999: exit 1
; error 21427 at 3:1
D1
M30
