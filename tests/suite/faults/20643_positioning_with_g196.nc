; check: exit 1
; error 20643 at 4:12
M3 S100
G196 S2000 M19
M30
