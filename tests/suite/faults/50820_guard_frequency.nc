; check: exit 1
; error 50820 at 3:1
#VIB GUARD ON [FREQ=600]
M30
