; run --set X.vib_guard.mode=2 --set X.vib_guard.freq=15 --set Y.vib_guard.mode=1 --set Y.vib_guard.freq=40 --set Z.vib_guard.mode=1 --set Z.vib_guard.freq=20: exit 0
; warning K-0112 at 5:1
(The path length of a cycle that is planned is smaller than that of the last one by 2e-13 mm.)
#SLOPE [TYPE=SIN2]
#VIB GUARD ON [AX_DEV=0.02]
#CONTOUR MODE ON [PTP PATH_DIST=1]
G01 F600
G01 X-18.2309 Y15.4410 Z-0.0264
G02 X-19.4069 Y13.7191 Z0.4535 R1.8292
G00 X2.0255 Y-7.2727 Z0.4535
G02 X1.9492 Y-7.3374 Z0.4535 R0.2815
G01 X1.9427 Y-7.4371 Z0.4535
G01 X14.1169 Y-13.7635 Z-0.1409
#CONTOUR MODE OFF
M30
