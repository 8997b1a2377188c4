; check: exit 1
; error K-0125 at 3:5
G96 S100
M30
