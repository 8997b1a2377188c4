; run --set X.vib_guard.mode=4 --set X.vib_guard.freq=30 --set Y.vib_guard.mode=2 --set Y.vib_guard.freq=40 --set Z.vib_guard.mode=2 --set Z.vib_guard.freq=30: exit 0
; warning K-0112 at 5:1
; The path length of a cycle that is planned is smaller than that of the last one by 2e-13 mm.
#SLOPE [TYPE=SIN2]
#VIB GUARD ON [AX_DEV=0.02]
#HSC ON [BSPLINE PATH_DEV=0.01]
G01 F12000
G01 X-0.5996 Y-1.9080 Z0.0000
G01 X-19.0352 Y-69.2383 Z0.9805
G01 X-9.2926 Y-71.4924 Z0.9805
G01 X-9.1948 Y-71.4717 Z0.9805
G00 X-9.1903 Y-71.4522 Z0.9805
G01 X-11.8099 Y-59.8333 Z0.9805
G01 X-40.8113 Y-67.5093 Z0.9805
M30
