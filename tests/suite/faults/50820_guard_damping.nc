; check: exit 1
; error 50820 at 3:1
#VIB GUARD ON [FREQ=40 DAMPING=1]
M30
