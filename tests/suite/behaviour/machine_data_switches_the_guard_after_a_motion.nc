; run: exit 0
; end X200
; warning K-0112 at 5:21
G01 X100 F6000
#MACHINE DATA [AX=X AXPARAM="vib_guard.active 1"]
X200
M30
