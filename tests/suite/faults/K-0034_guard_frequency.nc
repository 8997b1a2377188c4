; check: exit 1
; error K-0034 at 3:16
#VIB GUARD ON [FREQ=0.5]
M30
