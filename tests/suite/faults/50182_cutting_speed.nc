; check: exit 1
; error 50182 at 3:5
G96 S0
M30
