; check: exit 1
; error 20634 at 3:5
G96 S100
M30
