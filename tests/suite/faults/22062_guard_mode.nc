; check: exit 1
; error 22062 at 3:16
#VIB GUARD ON [MODE=5]
M30
