; check -m ../../tests/suite/machines/limited_tool --set tool.wz[1].vb_max=0: exit 1
; error 60296 at 3:1
D1
M3 S100
M30
