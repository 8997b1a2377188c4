; check: exit 1
; error 20042 at 3:5
G18 G51
M30
