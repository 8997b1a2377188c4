; check: exit 1
; error 21887 at 3:24
#VIB GUARD ON [FREQ=40 FREQ=50]
M30
