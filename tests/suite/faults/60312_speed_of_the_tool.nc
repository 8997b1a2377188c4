; check -m ../../tests/suite/machines/limited_tool --set S.kenngr.check_spindle_speed_in_tool_range=1: exit 1
; error 60312 at 4:1
D1
M3 S600
M30
