; check: exit 0
; note K-0103 at 3:1
#VIB GUARD [FREQ=40]
M30
