; check: exit 1
; error 120170 at 3:5
G96 S100
M30
