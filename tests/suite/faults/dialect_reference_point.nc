; check: exit 1
; error 20131 at 4:5
; once per program
G91 G28 Z0
G28 X0
M30
