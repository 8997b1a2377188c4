; run --set X.vib_guard.freq=5 --set Y.vib_guard.freq=30: exit 0
; warning K-0080 at 6:1
; warning K-0112 at 5:1
G01 F1000
#VIB GUARD ON [AX_DEV=0.001]
X5 Y5
M30
