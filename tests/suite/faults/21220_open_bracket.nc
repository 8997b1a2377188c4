; check: exit 1
; error 21220 at 3:22
#VIB GUARD ON [MODE=2
M30
