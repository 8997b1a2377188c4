; run: exit 0
; warning K-0075 at 4:21
#VIB GUARD ON [MODE=2 FREQ=33]
#MACHINE DATA [AX=X AXPARAM="vib_guard.mode 4"]
G01 X1 F1000
M30
