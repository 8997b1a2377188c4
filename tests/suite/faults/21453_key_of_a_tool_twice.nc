; check: exit 1
; error 21453 at 3:16
#TOOL DEF [A=1 A=2]
M30
