; check -m ../../tests/suite/machines/limited_tool: exit 1
; error 21038 at 3:1
D2
M30
