; check -m ../../tests/suite/machines/limited_tool --set tool.wz[1].vb_min=-1: exit 0
; warning 60332 at 3:1
D1
M3 S100
M30
